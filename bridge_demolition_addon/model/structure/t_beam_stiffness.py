"""Girders that are cast with a slab, as stiff as T-beams and slab of a grillage, however coarse their shards are.

Where girder and slab are cut across together, each piece of a T-beam is one shard of both, which hardly move against
each other. Its cuts are then elements of a beam (`elasticity.beam_elements`): both faces have their own area and second
moment, and together the T's; shear of the T is shared as web and slab are deep; the web twists as below a flange, the
slab half as a bar does, as in a grillage (E. C. Hambly 1991, Bridge Deck Behaviour, 3.3). As a shard of a web that
followed the slab sideways would close its cut against twist, it may turn about the vertical below the slab. Faces of
the slab between two girders are elements across, which bend between the webs: nodes are stiff for half of the web less
a quarter of the slab's thickness. What is cut finer than so, or otherwise, is as stiff as faces are.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.arrays import BoolArray, FloatArray, IntArray
from ...engineering.elasticity.section_stiffness import (
    SHEAR_FACTOR,
    BeamSection,
    ElasticModuli,
    measured_at,
    web_torsion_m4,
)
from ...engineering.geometry.road_lines import RoadLine
from ...engineering.geometry.vectors import product, unit
from ...engineering.mechanics.section_cuts import section_axes
from ..bridge.superstructure import cast_decks
from ..schema import given
from .connection_source import ConnectionRows, CutBridge

_WHOLE = 0.01
"""Part by which the area of a face may differ from that of a section, and its normal from level, that it is all of."""

_TURNS_BELOW_SLAB = 0.05
"""Part of a web's own twist with which it resists turning about the vertical: what holds it where nothing else does."""


def fit_to_t_beams(matrices: FloatArray, rows: ConnectionRows, cut: CutBridge) -> None:
    """Replace the stiffness (m, 6, 6) of faces, in the axes of their sections, by the T-beams' and the slab's."""
    if cut.scenario.bridge is None or cut.scenario.bridge.girders is None:
        return
    axes, joints = section_axes(rows.connections.normals), cut.scenario.joints
    for cast in _cast_t_beams(rows, cut):
        for row in np.flatnonzero(cast.of_faces(rows.connections.pairs)).tolist():
            turn = np.zeros((6, 6))
            turn[:3, :3] = turn[3:, 3:] = cast.on_road(row, axes[row])
            moduli = given(joints[int(rows.joints[row])].moduli)
            in_world = product(product(turn, matrices[row]), turn.T)
            fitted = cast.stiffness(row, in_world, moduli)
            if fitted is not None:
                matrices[row] = product(product(turn.T, fitted), turn)


@dataclass(frozen=True, slots=True, eq=False)
class _CastTBeams:
    """A slab and the girders below it, in n shards and the ground behind them."""

    rows: ConnectionRows
    centres_m: FloatArray  # (n + 1, 3), without skew
    line: IntArray  # (n + 1,), T-beam of each, -1 without one
    is_web: BoolArray  # (n + 1,)
    is_piece: BoolArray  # (n + 1,), whether it is all of its girder or slab in a piece of a T-beam
    points_m: FloatArray  # (m, 3), middles of faces, without skew
    headings: FloatArray | None  # (m, 2), directions in plan of a road that is curved, where faces are
    girders_m: FloatArray  # (g,), where girders are across the road
    widths_m: FloatArray  # (g,), of the slab of each
    slab_m: float
    web_m: tuple[float, float]  # width and depth, between haunches
    road: RoadLine | None  # that the slab follows

    def of_faces(self, pairs: IntArray) -> BoolArray:
        """Return which connections between pairs (m, 2) of shards are within these."""
        one, other = self.line[pairs.T]
        return np.asarray((one >= 0) & (other >= 0) & (abs(one - other) <= 1))

    def stiffness(self, row: int, faces: FloatArray, moduli: ElasticModuli) -> FloatArray | None:
        """Return the stiffness of a connection in the axes of the world, by the faces'; None where faces decide."""
        one, other = self.rows.connections.pairs[row].tolist()
        if self.line[one] != self.line[other]:
            return None if self.is_web[[one, other]].any() else self._across(row, faces, moduli)
        if not self.is_piece[[one, other]].all():
            return None
        if self.is_web[one] != self.is_web[other]:
            return self._below_slab(row, moduli)
        return self._along(row, moduli)

    def on_road(self, row: int, axes: FloatArray) -> FloatArray:
        """Return directions (3, k) of the world, where a face is, along the road, across it and upwards."""
        if self.headings is None:
            return axes
        along, left = self.headings[row].tolist()
        return product(np.array([[along, left, 0.0], [-left, along, 0.0], [0.0, 0.0, 1.0]]), axes)

    def _web_at(self, row: int) -> tuple[float, float]:
        """Width and depth of a web where a face is."""
        wide_m, deep_m = self.web_m
        return wide_m, deep_m * (self.road.factor_at(float(self.points_m[row, 0])) if self.road else 1.0)

    def _below_slab(self, row: int, moduli: ElasticModuli) -> FloatArray:
        """Of the face between a web and its slab."""
        one, other = self.centres_m[self.rows.connections.pairs[row]]
        area, between_m = float(self.rows.connections.areas[row]), float(abs(one - other)[2])
        long_m = area / self.web_m[0]
        about_x, about_y = (area * side * side / 12.0 for side in (self.web_m[0], long_m))
        young = moduli.young_pa / between_m
        twist = _TURNS_BELOW_SLAB * moduli.shear_pa / between_m * 4.0 * about_x
        return np.diag([young * area] * 3 + [young * about_x, young * about_y, twist])

    def _along(self, row: int, moduli: ElasticModuli) -> FloatArray | None:
        """Of a cut of a web or of its slab."""
        connections = self.rows.connections
        one, other = connections.pairs[row].tolist()
        normal = self.on_road(row, connections.normals[row][:, None])[:, 0]
        wide_m, web_m = self.widths_m[self.line[one]], self._web_at(row)
        section = BeamSection.rectangle(*(web_m if self.is_web[one] else (wide_m, self.slab_m)))
        if abs(normal[2]) > _WHOLE or abs(connections.areas[row] * abs(normal[0]) / section.area_m2 - 1.0) > _WHOLE:
            return None
        length_m = float(abs(self.centres_m[one] - self.centres_m[other])[0])
        web = BeamSection.rectangle(*web_m)
        slab = BeamSection.rectangle(wide_m, self.slab_m)
        deep_m, between_m = web_m[1] + self.slab_m, 0.5 * (web_m[1] + self.slab_m)
        both_m2 = web.area_m2 * slab.area_m2 / (web.area_m2 + slab.area_m2)
        whole = replace(
            web,
            about_y_m4=web.about_y_m4 + slab.about_y_m4 + both_m2 * between_m * between_m,
            shear_z_m2=SHEAR_FACTOR * web_m[0] * deep_m,
        ).joint(moduli, length_m)
        if self.is_web[one]:
            twisting_m4, part = web_torsion_m4(*web_m, self.slab_m), web_m[1] / deep_m
        else:
            twisting_m4, part = 0.5 * section.torsion_m4, self.slab_m / deep_m
        own = replace(section, torsion_m4=twisting_m4).joint(moduli, length_m)
        own[2, 2] = part * whole[2, 2]
        if not self.is_web[one]:
            own[1, 1] = own[0, 0]  # in its plane a slab shears in its faces along the road as well
        half_way = 0.5 * (self.centres_m[one] + self.centres_m[other])[0]
        return measured_at(own, np.array([half_way - self.points_m[row, 0], 0.0, 0.0]))

    def _across(self, row: int, faces: FloatArray, moduli: ElasticModuli) -> FloatArray:
        """Of a face of the slab between two girders: in its plane as faces are."""
        connections = self.rows.connections
        apart_m = float(abs(np.diff(self.girders_m[self.line[connections.pairs[row]]]))[0])
        clear_m = apart_m - max(self.web_m[0] - 0.5 * self.slab_m, 0.0)
        long_m = float(connections.areas[row]) / self.slab_m
        strip = BeamSection.rectangle(self.slab_m, long_m)
        poisson = 0.5 * moduli.young_pa / moduli.shear_pa - 1.0
        about_x = connections.areas[row] * self.slab_m * self.slab_m / 12.0 / (1.0 - poisson * poisson)
        bent = replace(strip, about_y_m4=about_x).joint(moduli, clear_m)
        own = faces.copy()
        twisted = moduli.shear_pa / clear_m * 2.0 * connections.areas[row] * self.slab_m * self.slab_m / 12.0
        for axis, value in ((2, bent[2, 2]), (3, bent[4, 4]), (4, twisted)):
            own[axis] = own[:, axis] = 0.0
            own[axis, axis] = value
        return own


def _cast_t_beams(rows: ConnectionRows, cut: CutBridge) -> Iterator[_CastTBeams]:
    bridge = given(cut.scenario.bridge)
    girders, number_of = given(bridge.girders), {member.name: number for number, member in enumerate(cut.members)}
    places: FloatArray = bridge.girder_spacing_m * (np.arange(girders.number, dtype=float) - 0.5 * (girders.number - 1))
    edges = np.concatenate(([-np.inf], 0.5 * (places[1:] + places[:-1]), [np.inf]))
    half_m = 0.5 * bridge.deck.width_m
    for deck, webs in cast_decks(bridge):
        if deck not in number_of or any(web not in number_of for web in webs):
            continue
        slab = cut.members[number_of[deck]]
        # As deep as they are, on a straight, level road.
        on_road = replace(slab.line, factors=None).from_world if slab.line else slab.without_skew
        points_m = on_road(rows.connections.points)
        centres = np.vstack((on_road(cut.centres_m), np.zeros(3)))
        line, of_members = np.full(len(centres), -1), np.append(cut.member_of_shard, -1)
        for girder, web in enumerate(webs):
            line[of_members == number_of[web]] = girder
        is_web, is_slab = line >= 0, of_members == number_of[deck]
        line[is_slab] = np.searchsorted(edges, centres[is_slab, 1]) - 1
        # Shards that do not move do not deform.
        is_web[:-1] &= ~cut.fixed
        line[:-1][cut.fixed] = -1
        one, other = rows.connections.pairs.T
        meet = (is_web[one] & is_slab[other]) | (is_slab[one] & is_web[other])
        faces_below = np.bincount(rows.connections.pairs[meet].ravel(), minlength=len(centres))
        alone = faces_below == 1
        is_piece = np.zeros(len(centres), bool)
        of_pieces = meet & alone[one] & alone[other]
        is_piece[rows.connections.pairs[of_pieces]] = True
        yield _CastTBeams(
            rows=rows,
            centres_m=centres,
            line=line,
            is_web=is_web,
            is_piece=is_piece,
            points_m=points_m,
            headings=unit(slab.line.directions(points_m, 0)[:, :2]) if slab.line and slab.line.radius_m else None,
            girders_m=places,
            widths_m=np.diff(np.clip(edges, -half_m, half_m)),
            slab_m=bridge.deck.thickness_m,
            web_m=(girders.width_m, girders.depth_m),
            road=slab.line,
        )
