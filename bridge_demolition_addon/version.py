"""Version of this program, for packages, reports and the command line."""

VERSION = "0.2.0"
