"""Objects of a scene as members, where they are seen."""

import math

import bpy
import numpy as np
import pytest

from bridge_demolition_addon.core.errors import GeometryError, ScenarioError
from bridge_demolition_addon.core.geometry.solids import box
from bridge_demolition_addon.scene.user_meshes import members_of_objects

# Blender keeps single precision of some metres.
SINGLE = 1e-6


@pytest.fixture
def add(blender):
    def add(size=(2, 1, 1), name="block", **values):
        mesh, solid = blender.data.meshes.new(name), box(size)
        mesh.from_pydata(solid.vertices, [], solid.faces.tolist())
        body = blender.data.objects.new(name, mesh)
        for key, value in values.items():
            setattr(body, key, value)
        blender.context.scene.collection.objects.link(body)
        return body

    return add


def member_of(body):
    bpy.context.view_layer.update()
    (member,) = members_of_objects([body], 2400.0).members
    return member


def test_an_object_where_it_stands(add):
    member = member_of(add(location=(10, 0, 5), rotation_euler=(0, 0, math.pi / 2)))
    assert (member.name, member.kind, member.density_kg_m3) == ("block", "member", 2400.0)
    np.testing.assert_allclose(member.solid.bounds, [[9.5, -1, 4.5], [10.5, 1, 5.5]], atol=1e-5)
    assert member.volume_m3 == pytest.approx(2, rel=SINGLE)


def test_a_scale_that_is_not_applied_counts(add):
    assert member_of(add(scale=(2, 3, 0.5))).volume_m3 == pytest.approx(6, rel=SINGLE)


def test_a_mirrored_object_is_a_solid_too(add):
    member = member_of(add(scale=(-1, 1, 1), location=(5, 0, 0)))
    assert member.solid.volume == pytest.approx(2, rel=SINGLE)


def test_parents_carry_their_children(add, blender):
    parent = blender.data.objects.new("parent", None)
    blender.context.scene.collection.objects.link(parent)
    parent.location, parent.scale, parent.rotation_euler = (0, 0, 10), (2, 1, 1), (0, 0, math.pi / 4)
    child = add(location=(1, 0, 0), rotation_euler=(0, 0, 0.3))
    child.parent = parent
    member = member_of(child)
    # Doubled by the parent; sheared, as the child is turned against the parent's scale.
    assert member.volume_m3 == pytest.approx(4, rel=SINGLE)
    half = math.sqrt(2.0)
    np.testing.assert_allclose(member.solid.center_mass, [half, half, 10], atol=1e-5)


def test_modifiers_are_applied_and_the_object_is_left_alone(add):
    body = add()
    array = body.modifiers.new("Array", "ARRAY")
    array.count, array.relative_offset_displace = 3, (2.0, 0, 0)
    member = member_of(body)
    assert member.volume_m3 == pytest.approx(6, rel=SINGLE)
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
    assert member_of(linked).volume_m3 == pytest.approx(4, rel=SINGLE)


def test_several_objects_are_cut_apart(add):
    first, second = add(name="deck"), add(name="kerb", location=(0.5, 0, 0.75))
    bpy.context.view_layer.update()
    prepared = members_of_objects([first, second], 2400.0, kind="deck")
    assert [member.kind for member in prepared.members] == ["deck", "deck"]
    # 1.5 x 1 x 0.25 m are in both.
    assert prepared.members[1].volume_m3 == pytest.approx(2 - 0.375, rel=1e-5)
    assert prepared.notes == ("kerb: 0.375 m³ cut off, as members before it take that room",)


def test_a_hole_is_closed_and_that_is_said(add, blender):
    mesh, solid = blender.data.meshes.new("open"), box([1, 1, 1])
    upper = solid.face_normals[:, 2] > 0.9
    mesh.from_pydata(solid.vertices, [], solid.faces[~upper].tolist())
    body = blender.data.objects.new("open", mesh)
    blender.context.scene.collection.objects.link(body)
    blender.context.view_layer.update()
    prepared = members_of_objects([body], 2400.0)
    assert prepared.notes == ("open: closed 1 hole",)
    assert prepared.members[0].volume_m3 == pytest.approx(1, rel=SINGLE)


def test_what_is_no_solid_is_refused_by_name(add, blender):
    blender.ops.object.light_add()
    light = blender.context.object
    empty = blender.data.objects.new("nothing", blender.data.meshes.new("nothing"))
    blender.context.scene.collection.objects.link(empty)
    flat = add(name="flat", scale=(1, 1, 0))
    blender.context.view_layer.update()
    for body, text in ((light, "is of type LIGHT, not a mesh"), (empty, "has no faces"), (flat, "encloses no volume")):
        with pytest.raises(GeometryError, match=f"^{body.name}: .*{text}"):
            members_of_objects([body], 2400.0)
    with pytest.raises(GeometryError, match="No objects are selected"):
        members_of_objects([], 2400.0)
    with pytest.raises(ScenarioError, match='two members are called "flat"'):
        flat.scale = (1, 1, 1)
        blender.context.view_layer.update()
        members_of_objects([flat, flat], 2400.0)
