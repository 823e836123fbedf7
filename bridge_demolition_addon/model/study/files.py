"""Names of the files in the folder of a study, a search or an optimisation.

The scenario lies beside them under its usual name. What is kept of a run lies in a folder of its own below
`RUNS_FOLDER`, named by its cache key.
"""

STUDY_FILE, SEARCH_FILE, OPTIMISE_FILE = "study.toml", "search.toml", "optimise.toml"
VERSIONS_FILE = "versions.json"

RUNS_FILE, SHEET_FILE, CONCLUSIONS_FILE = "runs.csv", "runs.xlsx", "study.json"
TRIALS_FILE = "trials.csv"
ANSWER_FILE, CURVE_FILE, CURVE_PICTURE = "search.json", "curve.csv", "curve.png"
CANDIDATES_FILE, BEST_FILE, TRADEOFF_PICTURE = "candidates.csv", "optimise.json", "tradeoff.png"

RUNS_FOLDER = "draws"
OUTCOME_FILE, OUTLINES_FILE = "outcome.json", "outlines.npz"

SIMULATED_FILE = "simulated.json"
"""Summary of a run that was simulated to its end, beside its frames: it is only to be evaluated."""

RUN_FOLDER = "run"
"""In the folder of a run, where more than its outcome is kept."""

AGAIN_FOLDER = "again"
"""Folders of runs that were repeated with everything recorded, named by their numbers."""

REPORT_FOLDER = "report"
PLAN_DXF, PLAN_GEOJSON = "study_plan.dxf", "study_plan.geojson"
