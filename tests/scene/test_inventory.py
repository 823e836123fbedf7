# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run knows of a scene before it begins, read from scenes built by the add-on and by hand."""

import numpy as np
import pytest
from support.scenarios import I235

from bridge_demolition_addon.engineering.structure.connections import GROUND, Connections
from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.model.results.arrays import named_arrays

# Blender keeps places, scales and masses in single precision: 24 binary digits, and a few roundings on the way.
SINGLE = 4 * 2.0**-23


@pytest.fixture
def blocks(blender):
    from support.blocks import Blocks

    return Blocks()


def inventory_of(scene):
    from bridge_demolition_addon.scene.bodies import bodies_of
    from bridge_demolition_addon.scene.connections.constraints import connections_of
    from bridge_demolition_addon.scene.inventory import take_inventory

    scene.view_layers[0].update()
    return take_inventory(bodies_of(scene), connections_of(scene))


@pytest.mark.parametrize("scale", [(1, 1, 1), (2, 1, 1), (0.5, 3, 2), (-1, 1, 1), (-2, -1, -1.5)])
@pytest.mark.parametrize("place", [(0, 0, 0), (100, -50, 20)])
def test_volumes_of_scaled_and_turned_blocks(blocks, scale, place):
    body = blocks.block(place, 7.0, (1.0, 2.0, 0.5))
    body.scale, body.rotation_euler = scale, (0.3, -0.5, 2.0)
    (volume,) = inventory_of(blocks.scene).volumes_m3
    assert volume == pytest.approx(abs(np.prod(scale)), rel=SINGLE)


def test_volumes_of_parts_of_a_larger_whole(blender, blocks):
    """A block takes the scale of what it is parented to, and its own on top."""
    body = blocks.block((0, 0, 0), 1.0)
    whole = blender.data.objects.new("Whole", None)
    blocks.scene.collection.objects.link(whole)
    whole.scale, body.scale, body.parent = (2, 2, 2), (1, 1, 3), whole
    assert inventory_of(blocks.scene).volumes_m3.tolist() == pytest.approx([24.0], rel=SINGLE)


def test_volumes_of_a_mesh_of_triangles_and_of_one_that_is_inside_out(blender, blocks):
    corners = [(0, 0, 0), (3, 0, 0), (0, 2, 0), (0, 0, 1)]
    outwards = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    for faces in (outwards, [face[::-1] for face in outwards]):
        mesh = blender.data.meshes.new("Tetrahedron")
        mesh.from_pydata(corners, [], faces)
        body = blender.data.objects.new("Tetrahedron", mesh)
        blocks.world.collection.objects.link(body)
    # A sixth of 3 × 2 × 1.
    np.testing.assert_allclose(inventory_of(blocks.scene).volumes_m3, [1.0, 1.0], rtol=SINGLE)


def test_volume_is_that_of_the_mesh_as_it_is_edited_last(blocks):
    body = blocks.block((0, 0, 0), 1.0)
    assert inventory_of(blocks.scene).volumes_m3.tolist() == pytest.approx([1.0], rel=SINGLE)
    for vertex in body.data.vertices:
        vertex.co *= 2.0
    assert inventory_of(blocks.scene).volumes_m3.tolist() == pytest.approx([8.0], rel=SINGLE)


def test_meshes_without_faces_have_no_volume(blender, blocks):
    """Bullet makes boxes of loose corners too; those next to them in order keep their volumes."""
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    for position in range(3):
        mesh = blender.data.meshes.new("Corners")
        mesh.from_pydata(corners if position else [], [], [])
        blocks.world.collection.objects.link(blender.data.objects.new("Corners", mesh))
        blocks.block((position, 0, 0), 1.0)
    blocks.world.collection.objects.link(blender.data.objects.new("Corners", mesh))
    volumes = inventory_of(blocks.scene).volumes_m3
    np.testing.assert_allclose(volumes, [0, 1, 0, 1, 0, 1, 0], rtol=SINGLE)


def test_masses_and_volumes_of_what_moves_and_of_what_does_not(blocks):
    blocks.block((0, 0, 0))
    blocks.block((0, 0, 2), 250.0, (1, 1, 2))
    held = blocks.block((0, 0, 5), 40.0, (2, 2, 2))
    held.rigid_body.kinematic = True  # by animation, and free later
    inventory = inventory_of(blocks.scene)
    assert inventory.masses_kg.tolist() == [0, 250, 40]
    np.testing.assert_allclose(inventory.volumes_m3, [0, 2, 8], rtol=SINGLE)


def test_names_and_kinds(blocks):
    from bridge_demolition_addon.engineering.timing.timeline import Timeline
    from bridge_demolition_addon.model.scenario import Ball, SurfaceValues
    from bridge_demolition_addon.scene.bodies import create_flat_ground
    from bridge_demolition_addon.scene.tools.ball import create_ball
    from bridge_demolition_addon.scene.tools.build_site import BuildSite

    blocks.block((0, 0, 0)).name = "Pier, left"
    blocks.block((0, 0, 2), 10.0).name = "Brücke"
    create_flat_ground(blocks.world, 10.0, SurfaceValues(0.8, 0.0))
    ball = Ball(mass_kg=500.0, diameter_m=1.0, target_m=(0.0, 0.0), drop_height_m=2.0, release_time_s=0.0)
    create_ball(
        BuildSite(blocks.world, Timeline.of(blocks.time.step.frame_s, 10.0), lambda _: 5.0, I235.surface_of), ball
    )
    inventory = inventory_of(blocks.scene)
    assert inventory.body_names.tolist() == ["Pier, left", "Brücke", "Ground", "Wrecking ball"]
    assert inventory.body_kinds.tolist() == ["ground", "shard", "ground", "ball"]
    assert inventory.masses_kg.tolist() == [0, 10, 0, 500]
    # The facets of a sphere of 88 around lie within it and leave 0.3 % of its volume out.
    assert inventory.volumes_m3[3] == pytest.approx(np.pi / 6, rel=5e-3)
    assert inventory.volumes_m3[3] < np.pi / 6


def made_connections(blender, blocks, shards, ground, connections, second_moments=None):
    from bridge_demolition_addon.scene.connections.constraints import create_connections
    from bridge_demolition_addon.scene.world import off_scene

    if second_moments is None:
        second_moments = np.zeros((len(connections), 2, 2))
    with off_scene(blocks.scene) as (_, collection):
        return create_connections(collection, connections, shards, ground, second_moments)


def test_connections_of_the_add_on_keep_their_sections(blender, blocks):
    ground = blocks.block((0, 0, -0.5))
    shards = [blocks.block((0, 0, 0.5), 1.0), blocks.block((3, 0, 4.5), 1.0)]
    normals = np.array([[0.6, 0.0, 0.8], [0.0, 0.0, -1.0]])
    connections = Connections(
        np.array([[0, 1], [0, GROUND]]), np.array([[1.5, 0, 2.5], [0, 0, 0]]), np.array([1 / 3, 12.5]), normals
    )
    second_moments = np.array([[[1 / 3, -0.25], [-0.25, 2.0]], [[5.0, 0.0], [0.0, 7.0]]])
    made = made_connections(blender, blocks, shards, ground, connections, second_moments)
    inventory = inventory_of(blocks.scene)
    assert inventory.connection_names.tolist() == [connection.name for connection in made]
    assert inventory.pairs.tolist() == [[1, 2], [1, 0]]  # the ground was made first
    np.testing.assert_allclose(inventory.points_m, connections.points, rtol=SINGLE)
    # Custom properties are kept in double precision.
    assert inventory.areas_m2.tolist() == [1 / 3, 12.5]
    assert inventory.normals.tolist() == normals.tolist()
    assert inventory.second_moments_m4.tolist() == second_moments.tolist()


def test_normals_of_the_add_on_are_those_of_the_face_and_not_of_the_centres(blender, blocks):
    shards = [blocks.block((0, 0, 0.5), 1.0), blocks.block((3, 0, 4.5), 1.0)]
    connections = Connections(np.array([[0, 1]]), np.zeros((1, 3)), np.ones(1), np.array([[0.0, 1.0, 0.0]]))
    made_connections(blender, blocks, shards, None, connections)
    assert inventory_of(blocks.scene).normals.tolist() == [[0, 1, 0]]


def test_connections_by_hand_have_no_area_and_point_from_first_to_second_body(blocks):
    low, high = blocks.block((0, 0, 0)), blocks.block((3, 0, 4), 1.0)
    blocks.connect("FIXED", (1.0, 0.0, 1.0), low, high)
    blocks.connect("HINGE", (1.0, 2.0, 1.0), high, low)
    inventory = inventory_of(blocks.scene)
    assert inventory.connection_names.tolist() == ["Connection 0", "Connection 1"]
    assert inventory.pairs.tolist() == [[0, 1], [1, 0]]
    assert inventory.points_m.tolist() == [[1, 0, 1], [1, 2, 1]]
    assert inventory.areas_m2.tolist() == [0, 0]
    assert inventory.second_moments_m4.tolist() == np.zeros((2, 2, 2)).tolist()
    np.testing.assert_allclose(inventory.normals, [[0.6, 0, 0.8], [-0.6, 0, -0.8]], rtol=SINGLE)


def test_a_connection_with_nothing_but_an_area_stands_for_a_square(blocks):
    connection = blocks.connect("FIXED", (0, 0, 0), blocks.block((0, 0, 0)), blocks.block((0, 0, 1), 1.0))
    connection["bda_area_m2"] = 4.0
    inventory = inventory_of(blocks.scene)
    assert inventory.areas_m2.tolist() == [4]
    # A square of 2 m: b h³ / 12 = 16/12 m⁴ about both axes. Rounding only.
    np.testing.assert_allclose(inventory.second_moments_m4, [np.eye(2) * 16 / 12], rtol=1e-15)


def test_by_hand_and_by_the_add_on_in_one_scene(blender, blocks):
    first, second = blocks.block((0, 0, 0), 1.0), blocks.block((0, 2, 0), 1.0)
    blocks.connect("POINT", (0, 1, 0), first, second)
    connections = Connections(np.array([[1, 0]]), np.ones((1, 3)), np.array([4.0]), np.array([[1.0, 0.0, 0.0]]))
    made_connections(blender, blocks, [first, second], None, connections)
    inventory = inventory_of(blocks.scene)
    order = np.argsort(inventory.areas_m2)
    assert inventory.areas_m2[order].tolist() == [0, 4]
    assert inventory.pairs[order].tolist() == [[0, 1], [1, 0]]
    np.testing.assert_allclose(inventory.normals[order], [[0, 1, 0], [1, 0, 0]], rtol=SINGLE)


def test_a_connection_by_hand_between_bodies_in_the_same_place_points_somewhere(blocks):
    blocks.connect("FIXED", (0, 0, 0), blocks.block((1, 2, 3)), blocks.block((1, 2, 3), 1.0))
    (normal,) = inventory_of(blocks.scene).normals
    assert np.linalg.norm(normal) == 1.0


def test_places_of_parented_connections_are_those_in_the_world(blender, blocks):
    connection = blocks.connect("FIXED", (1, 0, 0), blocks.block((0, 0, 0)), blocks.block((2, 0, 0), 1.0))
    parent = blender.data.objects.new("Parent", None)
    blocks.scene.collection.objects.link(parent)
    parent.location, connection.parent = (10, 20, 30), parent
    assert inventory_of(blocks.scene).points_m.tolist() == [[11, 20, 30]]


@pytest.mark.parametrize("side", ["object1", "object2"])
@pytest.mark.parametrize("instead", ["nothing", "no body", "body elsewhere"])
def test_a_connection_without_a_body_is_refused(blender, blocks, side, instead):
    connection = blocks.connect("FIXED", (0, 0, 0), blocks.block((0, 0, 0)), blocks.block((0, 0, 1), 1.0))
    connection.name = "Loose end"
    other = None
    if instead != "nothing":
        other = blender.data.objects.new("Other", blender.data.meshes.new("Other"))
        blocks.scene.collection.objects.link(other)
    if instead == "body elsewhere":
        blocks.world.collection.objects.link(other)
        blocks.world.collection.objects.unlink(other)
    setattr(connection.rigid_body_constraint, side, other)
    with pytest.raises(
        SimulationError, match="connection 'Loose end' lacks a body: give it two, or remove loose connections"
    ):
        inventory_of(blocks.scene)


def test_vertices_are_as_large_as_the_body_and_in_its_own_axes(blocks):
    blocks.block((0, 0, 0), size_m=(9, 9, 9))
    body = blocks.block((100, 5, -3), 7.0, (1.0, 2.0, 0.5))
    body.scale, body.rotation_euler = (2, 1, 4), (0.3, -0.5, 2.0)
    inventory = inventory_of(blocks.scene)
    assert inventory.vertex_counts.tolist() == [8, 8]
    corners = inventory.vertices_m[8:]
    np.testing.assert_allclose(np.ptp(corners, axis=0), (2.0, 2.0, 2.0), rtol=SINGLE)
    np.testing.assert_allclose(abs(corners), np.ones((8, 3)), rtol=SINGLE)


def test_members_are_known_where_they_are_marked(blocks):
    from bridge_demolition_addon.scene.bodies import mark_member

    blocks.block((0, 0, 0))
    pier, deck = (blocks.block((x, 0, 2), 1.0) for x in (0, 2))
    blocks.block((4, 0, 2), 1.0)
    mark_member(deck, "deck", "deck")
    mark_member(pier, "pier 1", "pier")
    inventory = inventory_of(blocks.scene)
    assert inventory.body_members.tolist() == ["", "pier 1", "deck", ""]
    assert inventory.body_member_kinds.tolist() == ["", "pier", "deck", ""]


def test_without_connections(blocks):
    blocks.block((0, 0, 0), 1.0)
    inventory = inventory_of(blocks.scene)
    shapes = {name: values.shape for name, values in named_arrays(inventory)}
    assert shapes == {
        "body_names": (1,),
        "body_kinds": (1,),
        "masses_kg": (1,),
        "volumes_m3": (1,),
        "body_members": (1,),
        "body_member_kinds": (1,),
        "vertices_m": (8, 3),
        "vertex_counts": (1,),
        "connection_names": (0,),
        "pairs": (0, 2),
        "points_m": (0, 3),
        "areas_m2": (0,),
        "normals": (0, 3),
        "second_moments_m4": (0, 2, 2),
    }
    assert inventory.pairs.dtype.kind == "i"


def test_an_empty_world(blocks):
    inventory = inventory_of(blocks.scene)
    assert {len(values) for _, values in named_arrays(inventory)} == {0}
