# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders with the tables that `bda stages` leaves."""

STAGES = """\
stage,time_s,step,shards,not_held,not_held_kg,equipment,weight_kN,reaction_x_kN,reaction_y_kN,reaction_z_kN,\
largest_utilisation,governed_by,between,at_x_m,at_y_m,at_z_m,overloaded,collapse_factor,sag_mm,first_frequency_Hz
1,0,as it was built,60,0,0,,500,0,0,500,0.42,bending,deck,1,0,5,0,2.31,3.4,5.1
2,0.5,"removal of pier <1>",55,0,0,excavator,480,0,0,480,1.3,shear,deck and pier,6,0,5,3,0.83,9.1,3.2
3,1,"saw cut of 4 connections",55,12,21000,,270,0,0,270,0.1,tension,deck,1,0,5,0,inf,1.1,9.0
"""
CRITICALITY = """\
member,stands,falls_kg,share_of_the_bridge
deck,true,0,0
pier 1,false,42000,0.55
"""


def with_stages(folder, stages=STAGES, members=CRITICALITY):
    """A folder with the tables of stages."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "stages.csv").write_text(stages, encoding="utf-8")
    (folder / "criticality.csv").write_text(members, encoding="utf-8")
    return folder
