# SPDX-License-Identifier: GPL-3.0-or-later
"""What the README of its examples says of the report of 2019 is complete, and of the present it is there."""

import csv
import re
import tomllib
from operator import attrgetter

import pytest
from support.checkout import ROOT
from support.scenarios import I235

TEXT = (ROOT / "examples" / "report_2019" / "README.md").read_text(encoding="utf-8")
PACKAGE = ROOT / "bridge_demolition_addon"
CODE = (PACKAGE / "README.md").read_text(encoding="utf-8")
"""Has what its code has become."""

TABLE_1 = """Wrecking Ball Mass, Bridge Total Mass, Bridge Model Geometry, Amounts of Explosives,
Explosion Source Points, Source Limit (Number of fractures), Noise, Neighbor Limit, Search Radius,
Friction Coefficient, Bounciness, Collision Margin, Activation Linear Velocity, Activation Angular Velocity,
Constraints Type, Constraint Breaking Threshold, Rigid Body Type, Collision Shape, Field_Hide, Field_Type,
Field_Z_Direction, Field_Shape, Field_Strength, Field_Flow, Field_Seed, Field_Apply_To_Location,
Field_Apply_To_Rotation, Field_Falloff_Power, Field_Falloff_Type, Field_Use_Min_Distance, Field_Use_Max_Distance,
Field_Distance_Max, Field_Use_Radial_Min, Field_Use_Radial_Max, Field_Radial_Max, Field_Radial_Falloff, Rotation_90"""

TABLE_2 = """Bridge Mass (single span), Wrecking Ball Mass, Fracturing Algorithm, Shard Count, Constraint Method,
Constraint Type, Constraint Limit per mesh island, Search Radius, Constraint Breaking Threshold"""

FIGURES = {*range(7, 15), 21, 33, 37, 39, 45, 47, *range(51, 74)}

APPENDIX = """bl_info USING_CONTOUR qRenderAnimation displaySteps fadeDecrement materialName SOURCE_POINT FIELD_HIDE
FIELD_RADIAL_FALLOFF ROTATION_90 CustomDrawOperator CustomDrawOperator2 MessageBox SceneItems AmountItems
DebrisLogFileOperator ForceLogFileOperator MassButtonOperator AddButtonOperator BuildButtonOperator ButtonOperator
DeleteOperator FancyPanel ExplosionVariables ExplosionPanel RegisterHandlerOperator UnregisterHandlerOperator
HandlerPanel ExplosionOperator total_mass log_debris_locations build_all_force_objects create_empty_obj
update_empty_objects explosion bmesh_from_object dot_product projected_area do_explosion main initExplosion
initBuffers initMaterials changeObjMaterials register unregister overpressure_ref overpressure_scaledDistance_contours2
overpressure_Plymoth_Bridge"""

FILES = (".toml", ".json", ".csv", ".npz", ".png", ".blend", ".mp4", ".log")


def section(heading, text=TEXT):
    """A section of a document, with those in it."""
    level = len(heading) - len(heading.lstrip("#"))
    return re.search(rf"^{re.escape(heading)}\n(.*?)(?=^#{{1,{level}}} |\Z)", text, flags=re.S | re.M).group(1)


def rows(text):
    """Cells of all rows of the tables in a text, without their headings."""
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return [row for row in cells if row[0] not in ("2019", "Figure") and not set(row[0]) <= {"-"}]


def ticked(text):
    """What stands between backticks."""
    return re.findall(r"`([^`]+)`", text)


def value_of(text):
    """A value as TOML has it."""
    return tomllib.loads(f"value = {text}")["value"]


def scenario_tables():
    """Every table of a scenario by its name, and whether there may be many of it."""
    from bridge_demolition_addon.model.scenario import Scenario
    from bridge_demolition_addon.model.schema import holds_many, subtable_class, subtable_fields

    def gather(table_class, many):
        yield table_class.table, (table_class, many)
        for item in subtable_fields(table_class):
            yield from gather(subtable_class(item), holds_many(item))

    return dict(gather(Scenario, False))


def scenario_keys():
    """The table of every key, and its field there."""
    from bridge_demolition_addon.model.schema import key_fields

    tables = scenario_tables().items()
    return {
        f"{name}.{item.name}": (name, item) for name, (table_class, _) in tables for item in key_fields(table_class)
    }


def named_keys(text):
    """Keys in a text, such as `ball.mass_kg` or `bridge.merge = true`."""
    found = [name for name in ticked(text) if re.match(r"[a-z_]+\.", name) and not name.endswith(FILES)]
    return [name for name in found if not name.startswith("bda.")]


def test_every_parameter_of_table_1_has_a_row_and_no_other():
    assert [row[0] for row in rows(section("## Parameters: Table 1"))] == TABLE_1.replace("\n", " ").split(", ")


def test_every_value_of_table_2_is_that_of_the_example():

    found = rows(section("## I-235: Table 2"))
    assert [row[0] for row in found] == TABLE_2.replace("\n", " ").split(", ")
    told = {ticked(key)[0]: value_of(ticked(value)[0]) for _, _, key, value in found if value}
    assert len(told) == len(found) - 1  # the way of cutting has no key
    assert told == {key: attrgetter(key)(I235) for key in told}


def test_every_simulation_and_chart_among_the_figures_is_there():
    found = set()
    for figure, *_ in rows(section("## Figures")):
        for part in figure.split(", "):
            first, *last = (int(number) for number in part.split(" to "))
            found |= set(range(first, (last or [first])[0] + 1))
    assert found == FIGURES


def test_every_name_of_the_appendix_is_there():
    told = {name for row in rows(section("## Code: Appendix A", CODE)) for name in ticked(row[0])}
    assert set(APPENDIX.split()) - told == set()


def test_every_key_is_one_and_its_link_leads_to_its_table():
    from bridge_demolition_addon.model.schema import checked

    keys, named = scenario_keys(), [named_key.partition(" = ") for named_key in named_keys(TEXT)]
    assert len(named) > 50
    assert [key for key, _, _ in named if key not in keys] == []
    given = [(key, value_of(value)) for key, _, value in named if value]
    assert given
    for key, value in given:
        assert checked(keys[key][1], key, value) == value
    links = re.findall(r"\[`([a-z_.0-9]+)`\]\([./]*docs/scenario\.md#(\w+)\)", TEXT)
    assert len(links) > 15
    assert [link for link in links if link[1] != keys[link[0]][0].replace(".", "")] == []


def test_every_table_is_one_and_has_its_brackets():
    tables = scenario_tables()
    named = re.findall(r"`(\[+)([a-z_.]+)\]+`", TEXT)
    assert len(named) > 5
    assert [name for brackets, name in named if tables[name][1] != (brackets == "[[")] == []


def test_every_column_of_our_logs_is_there_and_no_other():
    from bridge_demolition_addon.model.run_folder import logs

    columns = {
        "force_log.csv": logs.FORCE_TABLE.headers,
        "debris_log.csv": logs.DEBRIS_TABLE.headers,
        "explosion_log.csv": logs.EXPLOSION_TABLE.headers,
        "breaking_log.csv": logs.BREAKING_TABLE.headers,
        "bar_log.csv": logs.BAR_TABLE.headers,
    }
    told = {name: [] for name in columns}
    for _, now, _ in rows(section("## Logs")):
        file, *named = ticked(now)
        told[file] += named
    assert {name: sorted(columns_told) for name, columns_told in told.items()} == {
        name: sorted(columns[name]) for name in columns
    }


def test_every_operator_is_one(extension):
    named = set(re.findall(r"\bbda\.([a-z_]+)", TEXT))
    assert len(named) > 10
    assert named - set(dir(extension.ops.bda)) == set()


def test_every_operator_and_panel_is_in_the_file_beside_it():
    found = rows(section("### Operators and panels", CODE))
    assert len(found) > 8
    for _, now in found:
        files = re.findall(r"\]\(([^)]+\.py)\)", now)
        code = "".join((PACKAGE / file).read_text(encoding="utf-8") for file in files)
        assert [name for name in re.findall(r"\bbda\.([a-z_]+)", now) if f"class BDA_OT_{name}(" not in code] == []
        assert [name for name in re.findall(r"\*([^*]+)\*", now) if f'bl_label = "{name}"' not in code] == []


def test_every_name_in_italics_is_in_the_sidebar(extension):
    body = re.sub(r"\*\*[^*]+\*\*", "", TEXT.partition("## What comes out differently")[2])
    named = set(re.findall(r"\*([^*\n]+)\*", body))
    assert len(named) > 15
    assert named - sidebar_names(extension) == set()


def sidebar_names(extension):
    """Labels of all our panels and buttons, and names of all settings and their choices."""
    classes = [
        *extension.types.Panel.__subclasses__(),
        *extension.types.Operator.__subclasses__(),
    ]
    names = {cls.bl_label for cls in classes if cls.__module__.startswith("bridge_demolition_addon")}
    groups = [extension.context.scene.bda.bl_rna]
    while groups:
        for prop in groups.pop().properties:
            names.add(prop.name)
            if prop.type == "ENUM":
                names |= {item.name for item in prop.enum_items}
            if prop.type in ("POINTER", "COLLECTION") and prop.fixed_type.identifier.startswith("BDA_"):
                groups.append(prop.fixed_type)
    return names


def test_every_option_of_a_command_is_one(capsys):
    from bridge_demolition_addon.cli.main import main

    commands = [text.split() for text in ticked(TEXT) if text.startswith("bda ")]
    assert len(commands) > 10
    options = {}
    for _, command, *_ in commands:
        assert main([command, "--help"]) == 0
        options[command] = set(re.findall(r"--[a-z-]+", capsys.readouterr().out))
    assert [
        command for command in commands for word in command if word.startswith("--") and word not in options[command[1]]
    ] == []
    alone = {option for option in ticked(TEXT) if option.startswith("--")}
    assert alone <= set.union(*options.values())


def test_a_force_object_is_as_the_table_says(extension):
    from support.blocks import Blocks

    from bridge_demolition_addon.scene.blast.force_fields import (
        LONGEST_M,
        SHARE_OF_WAY,
        WIDEST_M,
        build_force_objects,
        force_objects,
    )

    blocks = Blocks()
    body = blocks.block((0.0, 0.0, 3.0), 100.0)
    build_force_objects(blocks.scene, [body])
    (empty,) = force_objects(blocks.scene).values()
    told = {row[0].lower().removeprefix("field_"): row[1] for row in rows(section("### Force Field"))}
    given = {name: ticked(cell)[0] for name, cell in told.items() if cell.startswith("`")}
    assert len(given) > 12
    assert given == {name: str(getattr(empty.field, name)) for name in given}
    # Its collection is hidden where the connections' is, as in a scene that was built: see tests/scene/rendering.
    assert "hidden" in told["hide"] and not empty.hide_get() and not empty.hide_viewport
    assert f"{WIDEST_M:g} m at most" in told["radial_max"]
    assert f"{WIDEST_M + LONGEST_M:g} m at most" in told["distance_max"]
    assert 0.4 < SHARE_OF_WAY < 0.5


def test_concrete_is_as_dense_as_blender_has_it(blender):
    blender.ops.mesh.primitive_cube_add(size=1.0)
    blender.ops.rigidbody.object_add()
    blender.ops.rigidbody.mass_calculate(material="Concrete")
    mass_kg = blender.context.object.rigid_body.mass  # of 1 m³, in single precision
    assert f"Concrete is `bridge.density_kg_m3 = {mass_kg:.0f}`" in TEXT
    assert mass_kg == pytest.approx(2320, rel=1e-6)


def test_fields_of_2019_push_nothing_at_their_own_place(blender):
    # Three empties in the body's centre, one turned along each axis, with the settings of the table's last column.
    bpy, moved = blender, {}
    for offset in (0.0, 0.01):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.context.scene.gravity = (0.0, 0.0, 0.0)
        bpy.ops.mesh.primitive_cube_add()
        body = bpy.context.object
        bpy.ops.rigidbody.object_add()
        for turned in (0, 1, None):
            bpy.ops.object.effector_add(type="FORCE", location=(offset, 0.0, 0.0))
            empty = bpy.context.object
            if turned is not None:
                empty.rotation_euler[turned] = 1.5707961
            field = empty.field
            field.shape, field.z_direction, field.falloff_type, field.falloff_power = "POINT", "BOTH", "TUBE", 10.0
            field.use_radial_max, field.radial_max, field.strength = True, 2.0, 100.0
        for frame in range(1, 6):
            bpy.context.scene.frame_set(frame)
        position = body.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation
        moved[offset] = position.length
    assert moved[0.0] == 0.0
    assert moved[0.01] > 0.1


def test_a_scene_prepared_by_hand_is_blasted_and_recorded(extension, tmp_path):
    # With Blender's own buttons alone: a block that hangs from a ledge, and a charge 5 m beside it.
    bpy, blocks = extension, []
    for height, kind in ((3.0, "ACTIVE"), (5.0, "PASSIVE")):
        bpy.ops.mesh.primitive_cube_add(size=1.0, location=(0.0, 0.0, height))
        bpy.ops.rigidbody.object_add(type=kind)
        blocks.append(bpy.context.object)
    blocks[0].rigid_body.mass = 250.0
    bpy.ops.object.empty_add(location=(0.0, 0.0, 4.0))
    bpy.ops.rigidbody.constraint_add(type="FIXED")
    constraint = bpy.context.object.rigid_body_constraint
    constraint.object1, constraint.object2 = blocks
    scene, settings = bpy.context.scene, bpy.context.scene.bda
    scene.frame_end = 30
    scene.cursor.location = (-5.0, 0.0, 3.0)
    assert bpy.ops.bda.add_source_point() == {"FINISHED"}
    assert bpy.ops.bda.build_force_objects() == {"FINISHED"}
    assert bpy.ops.bda.show_total_mass() == {"FINISHED"}
    assert settings.total_mass == "250 kg"
    symbols = [obj for obj in scene.objects if obj.type == "EMPTY" and not obj.name.startswith("Charge")]
    assert len(symbols) == 2
    for hidden in (True, False, True):  # a hidden connection holds all the same
        assert bpy.ops.bda.toggle_symbols() == {"FINISHED"}
        assert [symbol.visible_get() for symbol in symbols] == [not hidden] * 2
    settings.output_directory = str(tmp_path / "results")
    assert bpy.ops.bda.run() == {"FINISHED"}
    forces = rows_of(tmp_path / "results" / "force_log.csv")
    held = [float(row["force_z_N"]) for row in forces if row["body"] == blocks[0].name]
    # Before the charge goes off, after half a second, the connection carries the block's weight within what 10 passes
    # of the solver leave.
    assert held[10] == pytest.approx(250.0 * -scene.gravity.z, rel=1e-3)
    (load,) = rows_of(tmp_path / "results" / "explosion_log.csv")
    assert load["body"] == blocks[0].name
    assert float(load["stand_off_m"]) == pytest.approx(5.0, abs=1e-3)
    assert float(load["projected_area_m2"]) == pytest.approx(1.0, abs=1e-3)


def rows_of(log):
    """Lines of a log by its columns."""
    with log.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))
