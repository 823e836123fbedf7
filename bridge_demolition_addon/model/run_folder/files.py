"""Names of the files in the folder of a run. Those of its arrays are in `model/results/arrays.py`."""

from ..results.arrays import BALLS_FILE, CONTACTS_FILE, FRAMES_FILE, INVENTORY_FILE, RESULTS_FILE

SUMMARY_FILE = "summary.json"
FORCE_LOG, DEBRIS_LOG = "force_log.csv", "debris_log.csv"
BREAKING_LOG, EXPLOSION_LOG = "breaking_log.csv", "explosion_log.csv"
BEARING_LOG, BAR_LOG = "bearing_log.csv", "bar_log.csv"
GROUND_MOTION_FILE = "ground_motion.csv"
FORCE_CHART = "force_over_time.png"
BLEND_FILE = "scene.blend"

SCENARIO_FILE = "scenario_as_run.toml"
"""The scenario of the run. Not ``scenario.toml``, which may be the user's own, with comments in it."""

PICTURE_FOLDER = "frames"
PICTURES = BEFORE, IMPACT, AFTER = "before", "impact", "after"
"""Pictures in that folder, PNG."""

FILM_FILE, SLOW_FILM_FILE = "contours.mp4", "contours_slow_motion.mp4"

REPORT_PAGE, REPORT_PDF, REPORT_WORD = "report.html", "report.pdf", "report.docx"
SINGLE_PAGES = {audience: f"page_for_{audience}.pdf" for audience in ("client", "authority", "crew")}
"""Single pages of a report, by whom they are for."""

DXF_FILE, GEOJSON_FILE = "exclusion_zone_of_one_run.dxf", "exclusion_zone_of_one_run.geojson"
TABLE_FOLDER = "tables"
PLAN_WORKBOOK = "charge_plan.xlsx"
CHARGES_DXF, CHARGES_GEOJSON = "charge_plan.dxf", "charge_plan.geojson"

REPORT_FILES = (REPORT_PAGE, REPORT_PDF, *SINGLE_PAGES.values(), DXF_FILE, GEOJSON_FILE)
"""What a report leaves, without its tables. Word files stay, as blanks of theirs are filled in by hand."""

REPORT_LIST = "report_files.txt"
"""Which files a report left in its folder, a line each."""

RESULT_FILES = (
    SUMMARY_FILE,
    FORCE_LOG,
    DEBRIS_LOG,
    BREAKING_LOG,
    EXPLOSION_LOG,
    BEARING_LOG,
    BAR_LOG,
    GROUND_MOTION_FILE,
    RESULTS_FILE,
    FRAMES_FILE,
    BALLS_FILE,
    CONTACTS_FILE,
    INVENTORY_FILE,
    FORCE_CHART,
    BLEND_FILE,
    *(f"{PICTURE_FOLDER}/{name}.png" for name in PICTURES),
    FILM_FILE,
    SLOW_FILM_FILE,
    SCENARIO_FILE,
    *REPORT_FILES,
)
"""All that a run and its report can leave, in the order in which they are listed."""

SURVEY_FOLDER = "survey"
"""Of the report of a survey of the debris beside the run."""
