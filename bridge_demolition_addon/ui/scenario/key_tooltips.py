"""Tooltips of the keys of a scenario: what a key means, a typical value, its name in a file and what it takes.

Names are a scenario's; a key that several tables share stands here once, without its table.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, Field
from typing import Any

from ...model.schema import Key, Table, expected, key_name, key_of, value_type
from ...model.toml_tables import toml_value
from ..sidebar import tooltip

TYPICAL: dict[str, Any] = {
    "density_kg_m3": 2400.0,
    "mass_kg": 107000.0,
    "friction": 0.7,
    "restitution": 0.3,
    "stretch": [3, 1, 1],
    "position_m": [6.5, 0.0, 1.0],
    "target_m": [6.5, 0.0],
    "drop_height_m": 5.0,
    "breaking_force_n": 300000.0,
    "breaking_force_kgf": 30000.0,
    "elastic_modulus_n_mm2": 32000.0,
    "poisson_ratio": 0.2,
    "stiffness_n_m": 1e8,
    "damping_ns_m": 1e5,
    "turning_stiffness_nm_rad": 1e8,
    "turning_damping_nms_rad": 1e5,
    "time_s": 0.5,
    "lowest_corner_m": [-1.0, -5.0, 0.0],
    "highest_corner_m": [1.0, 5.0, 5.0],
    "time.duration_s": 5.0,
    "bridge.span_lengths_m": [13.0, 13.0],
    "bridge.alignment.end_grade_percent": -2.0,
    "bridge.alignment.curve_from_m": 5.0,
    "bridge.alignment.curve_to_m": 25.0,
    "bridge.alignment.tops_m": [5.3, 5.6, 5.8],
    "bridge.alignment.radius_m": 120.0,
    "bridge.haunches.length_m": 4.0,
    "bridge.haunches.depth_m": 0.5,
    "bridge.haunches.supports": [2, 3],
    "bridge.half_joints.span": 2,
    "bridge.half_joints.at_m": 5.0,
    "bridge.half_joints.length_m": 0.8,
    "bridge.deck.width_m": 8.5,
    "bridge.deck.thickness_m": 0.4,
    "bridge.girders.number": 5,
    "bridge.girders.width_m": 0.4,
    "bridge.girders.depth_m": 0.8,
    "bridge.girders.spacing_m": 2.0,
    "bridge.box_girder.width_m": 5.0,
    "bridge.box_girder.depth_m": 1.8,
    "bridge.box_girder.web_thickness_m": 0.3,
    "bridge.box_girder.bottom_thickness_m": 0.2,
    "bridge.voids.number": 7,
    "bridge.voids.diameter_m": 0.5,
    "bridge.pier_caps.end_height_m": 0.5,
    "bridge.piers.column_length_m": 0.7,
    "bridge.piers.column_width_m": 0.7,
    "bridge.piers.height_m": 4.9,
    "bridge.piers.feet_apart_m": 1.5,
    "bridge.other_piers.piers": [2],
    "bridge.other_piers.columns": 3,
    "bridge.other_piers.column_length_m": 0.9,
    "bridge.other_piers.column_width_m": 0.9,
    "bridge.other_piers.batter_percent": 5.0,
    "bridge.other_piers.feet_apart_m": 1.5,
    "bridge.pier_caps.length_m": 1.0,
    "bridge.pier_caps.width_m": 8.5,
    "bridge.pier_caps.height_m": 0.6,
    "bridge.abutments.length_m": 1.5,
    "bridge.abutments.width_m": 9.0,
    "bridge.abutments.height_m": 5.0,
    "bridge.arch.span_m": 35.0,
    "bridge.arch.rise_m": 7.0,
    "bridge.arch.springing_m": 1.0,
    "bridge.arch.thickness_m": 0.7,
    "bridge.arch.width_m": 5.0,
    "bridge.arch.to_support": 8,
    "bridge.arch.block_length_m": 3.0,
    "bridge.frame.clear_height_m": 5.5,
    "bridge.frame.leg_thickness_m": 0.8,
    "bridge.frame.leg_width_m": 8.0,
    "time.farthest_per_substep_m": 0.01,
    "time.solver_iterations": 100,
    "steelwork.nodes.radius_m": 0.3,
    "steelwork.members.eccentricities_m": [[0.0, 0.0, 0.2], [0.0, 0.0, 0.2]],
    "steelwork.members.pieces": 8,
    "steelwork.trusses.length_m": 32.0,
    "steelwork.trusses.panels": 8,
    "steelwork.trusses.height_m": 5.0,
    "steelwork.trusses.spacing_m": 6.0,
    "steelwork.members.stiffener_spacing_m": 1.5,
    "steelwork.girders.span_lengths_m": [25.0],
    "steelwork.girders.girders": 3,
    "steelwork.girders.spacing_m": 2.6,
    "steelwork.girders.fields": [5],
    "steelwork.girders.pieces": 3,
    "steelwork.girders.pier_length_m": 6.0,
    "steelwork.girders.deck_thickness_m": 0.2,
    "steelwork.girders.deck_width_m": 8.0,
    "steelwork.girders.studs_per_m": 6.0,
    "steelwork.girders.stud_strength_n": 90000.0,
    "steelwork.girders.stud_diameter_mm": 19.0,
    "steelwork.girders.stud_uplift_n": 40000.0,
    "steelwork.girders.stiffener_spacing_m": 1.5,
    "tendons.points_m": [[0.0, 0.0, 4.5], [10.0, 0.0, 4.1], [20.0, 0.0, 4.5]],
    "tendons.eccentricities_m": [0.0, 0.35, 0.0],
    "tendons.area_mm2": 1500.0,
    "tendons.prestress_n_mm2": 1050.0,
    "machines.position_m": [4.0, -9.0, 0.0],
    "machines.reach_m": 11.0,
    "machines.members": ["pier 1"],
    "machines.output_m3_h": 8.0,
    "machines.sound_power_db": 120.0,
    "programme.possessions.from_h": 22.0,
    "programme.possessions.to_h": 29.0,
    "programme.tasks.volume_m3": 60.0,
    "programme.tasks.hours_h": 4.0,
    "fall_beds.corners_m": [[0.0, -8.0], [20.0, -8.0], [20.0, 8.0], [0.0, 8.0]],
    "fall_beds.thickness_m": 1.5,
    "fall_beds.modulus_kpa": 10000.0,
    "dead_loads.mass_kg_m2": 240.0,
    "dead_loads.mass_kg_m": 600.0,
    "dead_loads.across_m": [-4.0, 4.0],
    "dead_loads.along_m": [0.0, 13.0],
    "dead_loads.until_s": 0.1,
    "ground.profile_m": [[-2.0, 3.0], [4.0, 0.0]],
    "ground.origin": [448250.0, 4607150.0, 262.5],
    "ground.bearing_deg": 90.0,
    "ground.no_data": -9999.0,
    "ground.surfaces.height_m": 0.2,
    "ground.surfaces.corners_m": [[-5.0, 8.0], [20.0, 8.0], [20.0, 12.0]],
    "fracture.shards": 200,
    "fracture.members.shards": 50,
    "fracture.members.share": 0.5,
    "fracture.finer.radius_m": 2.0,
    "fracture.finer.factor": 4.0,
    "materials.compression_n_mm2": 30.0,
    "materials.tension_n_mm2": 2.0,
    "materials.shear_n_mm2": 3.0,
    "materials.torsion_n_mm2": 2.0,
    "materials.bending_n_mm2": 3.0,
    "reinforcement.depth_m": 0.05,
    "reinforcement.spread_mm2_m2": 1500.0,
    "reinforcement.area_mm2": 10000.0,
    "reinforcement.from_m": 10.0,
    "reinforcement.to_m": 16.0,
    "connections.search_radius_m": 1.0,
    "connections.neighbours": 12,
    "connections.damping_ratio": 0.05,
    "connections.ductile_elongation_m": 0.05,
    "connections.ductile_yield_n_mm2": 500.0,
    "connections.ductile_hardening": 1.08,
    "connections.ductile_rupture_strain": 0.05,
    "ball.mass_kg": 10000.0,
    "ball.diameter_m": 1.35,
    "ball.contact_time_s": 0.005,
    "ball.hits.lift_time_s": 2.0,
    "ball.hits.release_time_s": 5.0,
    "ball.cable.crane_point_m": [6.5, -4.0, 20.0],
    "ball.cable.length_m": 12.0,
    "ball.cable.angle_degrees": 45.0,
    "blast.constant_decay": 1.0,
    "blast.slow_frame_ms": 1.0,
    "cuts.position_m": 3.0,
    "cuts.mass_kg": 2.0,
    "blast_zones.middle_m": 1.5,
    "blast_zones.height_m": 1.5,
    "blast_zones.holes_a_row": 4,
    "blast_zones.row_spacing_m": 0.35,
    "blast_zones.depth_m": 0.45,
    "blast_zones.stemming_m": 0.3,
    "blast_zones.charge_g": 75.0,
    "blast_zones.break_kg_m3": 0.3,
    "blast_zones.bar_diameter_mm": 25.0,
    "jackhammers.start_time_s": 0.5,
    "jackhammers.end_time_s": 4.0,
    "jackhammers.stroke_m": 0.4,
    "jackhammers.depth_m": 0.3,
    "jackhammers.path_m": [[2.0, 0.0], [4.0, 0.0]],
    "saw_cuts.point_m": [6.5, 0.0, 5.0],
    "saw_cuts.normal": [1.0, 0.0, 0.0],
    "weakenings.factor": 0.3,
    "pulls.point_m": [1.5, 0.0, 12.0],
    "pulls.anchor_m": [31.5, 0.0, 0.5],
    "pulls.start_s": 1.0,
    "pulls.speed_m_s": 0.2,
    "pulls.growth_n_s": 20000.0,
    "pulls.largest_force_n": 100000.0,
    "pulls.breaking_force_n": 500000.0,
    "pulls.diameter_mm": 28.0,
    "pulls.stiffness_n": 4e7,
    "pulls.free_length_m": 32.0,
    "lifts.from_s": 1.0,
    "lifts.lift_s": 5.0,
    "lifts.capacity_kg": 45000.0,
    "lifts.sling_points_m": [[2.5, 0.0, 6.0], [9.5, 0.0, 6.0]],
    "lifts.hook_m": [6.0, 0.0, 14.0],
    "lifts.crane_m": [6.0, 14.0],
    "loads.point_m": [6.5, 0.0, 5.0],
    "loads.times_s": [0.0, 5.0],
    "loads.forces_n": [0.0, 500000.0],
    "zones.bottom_m": 0.0,
    "zones.top_m": 5.0,
    "zones.corners_m": [[-5.0, 8.0], [20.0, 8.0], [20.0, 12.0]],
    "exclusion.buffer_m": 5.0,
    "exclusion.cordon_m": 300.0,
    "site.latitude_deg": 41.6,
    "site.longitude_deg": -93.6,
    "equipment.footprint_m": [4.0, 3.0],
    "equipment.until_s": 4.0,
    "bridge.bearings.pinned_at": 2,
    "bridge.bearings.friction": 0.05,
    "bridge.bearings.pads": 4,
    "bridge.reinforcement.traffic_kn_m2": 5.0,
    "bridge.reinforcement.axles_kn": [100.0, 100.0],
    "bridge.reinforcement.axle_spacing_m": [1.2],
    "bridge.reinforcement.carriageway_m": 7.5,
    "bridge.reinforcement.concrete_n_mm2": 35.0,
    "geometry_reinforcement.traffic_kn_m2": 5.0,
    "geometry_reinforcement.axles_kn": [100.0, 100.0],
    "geometry_reinforcement.axle_spacing_m": [1.2],
    "geometry_reinforcement.carriageway_m": 7.5,
    "geometry_reinforcement.concrete_n_mm2": 35.0,
    "bridge.reinforcement.ratios.bottom_percent": 0.8,
    "bridge.reinforcement.ratios.top_percent": 0.4,
    "bridge.reinforcement.ratios.across_bottom_percent": 0.2,
    "bridge.reinforcement.ratios.across_top_percent": 0.2,
    "bridge.reinforcement.ratios.upright_percent": 1.0,
    "bridge.reinforcement.ratios.links_percent": 0.1,
    "bearings.pads": 4,
    "bearings.spacing_m": 2.0,
    "bearings.positions_m": [-2.0, 0.0, 2.0],
    "bearings.pad_m": [0.3, 0.4],
    "bearings.friction": 0.05,
    "bearings.stiffness_mn_m": 1000.0,
    "bearings.shear_mn_m": 2.0,
    "bearings.rotation_mnm_rad": 2.0,
    "bearings.breaking_force_n": 500000.0,
    "foundations.stiffness_mn_m3": 50.0,
    "foundations.capacity_kpa": 600.0,
    "foundations.friction": 0.5,
    "foundations.footing_m": [3.0, 3.0],
    "ground_motion.sweep.from_hz": 0.5,
    "ground_motion.sweep.to_hz": 10.0,
    "ground_motion.sweep.duration_s": 20.0,
    "ground_motion.sweep.acceleration_m_s2": 1.0,
    "ground_motion.spectrum.acceleration_m_s2": 2.0,
    "neighbours.position_m": [6.5, 30.0, 1.5],
    "neighbours.limit_mm_s": 5.0,
    "neighbours.limit_db": 120.0,
    "vibration_laws.velocity_mm_s": 800.0,
    "vibration_laws.exponent": 1.6,
    "vibration_laws.scatter": 0.4,
    "vibration_laws.events": 12,
    "vibration_laws.scaled": [5.0, 20.0, 80.0],
    "vibration_laws.spread": 0.8,
    "pictures.camera_m": [6.5, -30.0, 10.0],
    "pictures.look_at_m": [6.5, 0.0, 3.0],
    "vary.mean": 5.0,
    "vary.deviation": 0.5,
    "vary.median": 300000.0,
    "vary.variation": 0.2,
    "vary.lowest": 4.0,
    "vary.most_likely": 5.0,
    "vary.highest": 6.0,
    "criteria.share": 0.5,
    "criteria.span": 1,
    "criteria.limit_kpa": 2.0,
    "criteria.limit_mm_s": 20.0,
    "study.time_limit_s": 600.0,
    "study.memory_limit_mb": 4000.0,
    "search.lowest": 0.1,
    "search.highest": 4.0,
    "search.spread": 0.4,
    "search.step": 0.5,
    "search.within": 0.1,
    "quantities.lowest": 0.1,
    "quantities.highest": 4.0,
    "quantities.step": 0.5,
}


def typical_value(table_class: type[Table], item: Field) -> Any:
    """Return a typical value of a key: its default, or one of `TYPICAL`; None for a text without a default."""
    name = key_name(table_class, item)
    if key_of(item).typical is not None:
        return key_of(item).typical
    if name in TYPICAL:
        return TYPICAL[name]
    if item.default not in (MISSING, None):
        return item.default
    return TYPICAL.get(item.name)


def typical_text(table_class: type[Table], item: Field) -> str:
    """Return a typical value with its unit, such as ``0.4 m``; empty where there is none."""
    value = typical_value(table_class, item)
    if value is None or isinstance(value, bool | str):
        return ""
    unit = key_of(item).unit
    return f"{toml_value(value)}{' ' + unit if unit else ''}"


IN_FILE = "{}. In a scenario file: {}"
WITH_TYPICAL = "{}. Typical: {}. In a scenario file: {}"
"""Patterns of tooltips in other languages: meaning, typical value, name and limits."""


def meaning_of(item: Field) -> str:
    """Return what a key means, as the tables of languages have it."""
    return tooltip(key_of(item).description)


def tooltip_of(table_class: type[Table], item: Field) -> str:
    """Return the tooltip of a key."""
    typical = typical_text(table_class, item)
    description = key_of(item).description + (f" Typical: {typical}." if typical else "")
    return tooltip(f"{description} In a scenario file: {key_name(table_class, item)}, {expected(item)}")


def translated_tooltip(table_class: type[Table], item: Field, tooltips: Mapping[str, str]) -> str | None:
    """Return the tooltip of a key from the table of a language; None where that lacks the key's meaning."""
    meaning, typical = tooltips.get(meaning_of(item)), typical_text(table_class, item)
    if meaning is None:
        return None
    in_file = ", ".join(filter(None, (key_name(table_class, item), _limits_in_signs(item))))
    if typical:
        return tooltips.get(WITH_TYPICAL, WITH_TYPICAL).format(meaning, typical, in_file)
    return tooltips.get(IN_FILE, IN_FILE).format(meaning, in_file)


def _limits_in_signs(item: Field) -> str:
    """Return what a key takes, in symbols, so that nothing needs translation."""
    rule = key_of(item)
    if value_type(item) is bool:
        return "true | false"
    if rule.choices:
        return " | ".join(rule.choices)
    return " ".join(filter(None, (_range(rule), rule.unit)))


def _range(rule: Key) -> str:
    if rule.at_least is not None and rule.at_most is not None:
        return f"{rule.at_least} … {rule.at_most}"
    signs = {">": rule.above, "≥": rule.at_least, "≤": rule.at_most}
    return ", ".join(f"{sign} {limit}" for sign, limit in signs.items() if limit is not None)
