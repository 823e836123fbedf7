"""Names of the files in the folder of an optimisation, besides those of a study."""

OPTIMISE_FILE = "optimise.toml"
TRIALS_FILE, CANDIDATES_FILE, BEST_FILE = "trials.csv", "candidates.csv", "optimise.json"
TRADEOFF_PICTURE = "tradeoff.png"
