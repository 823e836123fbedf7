# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of what is done in the middle of a simulation (job upheaval), and of what the extension does meanwhile."""

UPHEAVALS = (
    "undo",
    "redo",
    "delete_shard",
    "delete_shard_and_connections",
    "delete_connection",
    "remove_shard_by_script",
    "new_file",
    "open_file",
    "switch_off",
)
"""The functions of job_upheaval.py."""

RECORDED, WATCHED, ALONE = "recorded", "watched", "alone"
"""A recording runs; the extension is on and the timeline is just played; the extension is off."""


def job(upheaval: str, company: str) -> str:
    """Name of the job that does one."""
    return f"upheaval-{upheaval}-{company}"
