"""What the files in the folder of a search are called; its trials lie there as the draws of a study do."""

SEARCH_FILE = "search.toml"
TRIALS_FILE, ANSWER_FILE = "trials.csv", "search.json"
CURVE_FILE, CURVE_PICTURE = "curve.csv", "curve.png"
