"""What the files in the folder of a study are called, for who writes them and who reads them.

The scenario lies beside the study under its usual name, and what is kept of a draw in a folder of its own below
`DRAW_FOLDER`, called by its address.
"""

STUDY_FILE, VERSIONS_FILE = "study.toml", "versions.json"
RUNS_FILE, SHEET_FILE, CONCLUSIONS_FILE = "runs.csv", "runs.xlsx", "study.json"

DRAW_FOLDER = "draws"
OUTCOME_FILE, OUTLINES_FILE = "outcome.json", "outlines.npz"

RUN_FOLDER = "run"
"""In the folder of a draw, where more than its outcome is kept."""

AGAIN_FOLDER = "again"
"""Folders of draws that were run once more with everything, called by their numbers."""

REPORT_FOLDER = "report"
PLAN_DXF, PLAN_GEOJSON = "study_plan.dxf", "study_plan.geojson"
