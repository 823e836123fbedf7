# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects of a scene as solids, where they are seen, and the paint on them."""

import math

import bpy
import numpy as np
import pytest

from bridge_demolition_addon.engineering.fracture.options import painted_density
from bridge_demolition_addon.engineering.geometry.mesh import triangle_areas_and_normals, volumes_and_centres
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.errors import GeometryError
from bridge_demolition_addon.scene.user_meshes import painted_points, solid_of_object

# Blender keeps single precision of some metres.
SINGLE = 1e-6


@pytest.fixture
def add(blender):
    def add(size=(2, 1, 1), name="block", **values):
        mesh, solid = blender.data.meshes.new(name), box(size)
        mesh.from_pydata(solid.vertices, [], solid.triangles.tolist())
        body = blender.data.objects.new(name, mesh)
        for key, value in values.items():
            setattr(body, key, value)
        blender.context.scene.collection.objects.link(body)
        return body

    return add


def solid_of(body):
    bpy.context.view_layer.update()
    return solid_of_object(body).solid


def test_an_object_where_it_stands(add):
    solid = solid_of(add(location=(10, 0, 5), rotation_euler=(0, 0, math.pi / 2)))
    np.testing.assert_allclose(solid.bounds, [[9.5, -1, 4.5], [10.5, 1, 5.5]], atol=1e-5)
    assert solid.volume == pytest.approx(2, rel=SINGLE)


def test_a_scale_that_is_not_applied_counts(add):
    assert solid_of(add(scale=(2, 3, 0.5))).volume == pytest.approx(6, rel=SINGLE)


def test_a_mirrored_object_is_a_solid_too(add):
    solid = solid_of(add(scale=(-1, 1, 1), location=(5, 0, 0)))
    assert solid.volume == pytest.approx(2, rel=SINGLE)


def test_parents_carry_their_children(add, blender):
    parent = blender.data.objects.new("parent", None)
    blender.context.scene.collection.objects.link(parent)
    parent.location, parent.scale, parent.rotation_euler = (0, 0, 10), (2, 1, 1), (0, 0, math.pi / 4)
    child = add(location=(1, 0, 0), rotation_euler=(0, 0, 0.3))
    child.parent = parent
    solid = solid_of(child)
    # Doubled by the parent; sheared, as the child is turned against the parent's scale.
    assert solid.volume == pytest.approx(4, rel=SINGLE)
    half = math.sqrt(2.0)
    np.testing.assert_allclose(volumes_and_centres([solid])[1][0], [half, half, 10], atol=1e-5)


def test_modifiers_are_applied_and_the_object_is_left_alone(add):
    body = add()
    array = body.modifiers.new("Array", "ARRAY")
    array.count, array.relative_offset_displace = 3, (2.0, 0, 0)
    solid = solid_of(body)
    assert solid.volume == pytest.approx(6, rel=SINGLE)
    assert len(body.data.vertices) == 8 and len(body.modifiers) == 1
    assert len(bpy.data.meshes) == 1 and len(bpy.data.objects) == 1


def test_linked_objects_are_taken_as_they_are(add, blender, tmp_path):
    source = add(scale=(2, 1, 1))
    library = str(tmp_path / "library.blend")
    blender.data.libraries.write(library, {source})
    blender.ops.wm.read_factory_settings(use_empty=True)
    with blender.data.libraries.load(library, link=True) as (_, wanted):
        wanted.objects = ["block"]
    linked = blender.data.objects["block"]
    blender.context.scene.collection.objects.link(linked)
    assert linked.library is not None
    assert solid_of(linked).volume == pytest.approx(4, rel=SINGLE)


def test_a_hole_is_closed_and_that_is_said(add, blender):
    mesh, solid = blender.data.meshes.new("open"), box([1, 1, 1])
    upper = triangle_areas_and_normals(solid.corners)[1][:, 2] > 0.9
    mesh.from_pydata(solid.vertices, [], solid.triangles[~upper].tolist())
    body = blender.data.objects.new("open", mesh)
    blender.context.scene.collection.objects.link(body)
    blender.context.view_layer.update()
    done = solid_of_object(body)
    assert done.repairs == ("closed 1 hole",)
    assert done.solid.volume == pytest.approx(1, rel=SINGLE)


def test_what_is_no_solid_is_refused_by_name(add, blender):
    blender.ops.object.light_add()
    light = blender.context.object
    empty = blender.data.objects.new("nothing", blender.data.meshes.new("nothing"))
    blender.context.scene.collection.objects.link(empty)
    flat = add(name="flat", scale=(1, 1, 0))
    blender.context.view_layer.update()
    for body, text in ((light, "is of type LIGHT, not a mesh"), (empty, "has no faces"), (flat, "encloses no volume")):
        with pytest.raises(GeometryError, match=f"^{body.name}: .*{text}"):
            solid_of_object(body)


def test_paint_becomes_density(blender):
    mesh, solid = blender.data.meshes.new("deck"), box([4, 2, 1])
    mesh.from_pydata(solid.vertices, [], solid.triangles.tolist())
    body = blender.data.objects.new("deck", mesh)
    blender.context.scene.collection.objects.link(body)
    body.location, body.scale = (10, 0, 0), (2, 1, 1)
    group = body.vertex_groups.new(name="finer")
    group.add([index for index, vertex in enumerate(mesh.vertices) if vertex.co.x > 0], 0.5, "REPLACE")
    blender.context.view_layer.update()
    points, weights = painted_points(body, "finer")
    np.testing.assert_allclose(points, np.asarray(solid.vertices) * (2, 1, 1) + (10, 0, 0), atol=1e-6)
    assert sorted(set(weights)) == [0.0, 0.5]
    at = painted_density(points, weights, 5.0).at(np.array([[14.0, 1.0, 0.5], [6.0, 1.0, 0.5], [10.0, 0.0, 0.0]]))
    assert at == pytest.approx([3, 1, 2], rel=1e-6)
    with pytest.raises(GeometryError, match=r"deck: has no vertex group 'coarse'; paint one, or choose from: finer"):
        painted_points(body, "coarse")
    empty = blender.data.objects.new("empty", None)
    with pytest.raises(GeometryError, match="empty: is of type EMPTY, not a mesh"):
        painted_points(empty, "finer")
