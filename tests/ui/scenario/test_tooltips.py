# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tooltips of the sidebar say."""

import re

from support.checkout import ROOT

from bridge_demolition_addon.model.schema import expected, key_name, key_of
from bridge_demolition_addon.ui.registration import classes
from bridge_demolition_addon.ui.scenario.key_tooltips import TYPICAL, typical_value
from bridge_demolition_addon.ui.scenario.prop import all_tables, group_name, registered_group, shown_keys

FROM_2019 = (ROOT / "examples" / "report_2019" / "README.md").read_text(encoding="utf-8")
NUMBERS = ("FLOAT", "INT")


def groups(extension):
    """All property groups of the sidebar: of the settings, of scenario and study, and of their lists."""
    found = [extension.types.Scene.bl_rna.properties["bda"].fixed_type]
    found += [registered_group(group_name(table)).bl_rna for table in all_tables()]
    return found


def shown_properties(extension):
    return [
        (group.identifier, prop)
        for group in groups(extension)
        for prop in group.properties
        if prop.identifier not in ("rna_type", "name", "given") and not prop.is_hidden
    ]


def test_every_field_has_a_tooltip(extension):
    found = shown_properties(extension)
    assert len(found) > 300
    assert [f"{group}.{prop.identifier}" for group, prop in found if len(prop.description) < 10] == []


def test_no_tooltip_ends_with_a_full_stop(extension):
    """Blender adds one."""
    fields = [(f"{group}.{prop.identifier}", prop.description) for group, prop in shown_properties(extension)]
    panels = [(cls.__name__, cls.bl_description) for cls in classes() if issubclass(cls, extension.types.Panel)]
    buttons = [
        (cls.__name__, getattr(cls, "bl_description", None) or cls.__doc__)
        for cls in classes()
        if issubclass(cls, extension.types.Operator)
    ]
    assert [name for name, text in (*fields, *panels, *buttons) if text.endswith(".") or not text] == []


def test_buttons_and_panels_of_2019_say_their_old_names(extension):
    rows = re.findall(r"^\| ([A-Z][^|]*) \| [^|]* \| `bda\.(\w+)`", FROM_2019, flags=re.M)
    assert len(rows) > 6
    named = {idname: getattr(extension.types, f"BDA_OT_{idname}") for _, idname in rows}
    for old_name, idname in rows:
        assert old_name == named[idname].bl_label or f"called {old_name} in 2019" in named[idname].__doc__


def test_every_number_says_a_value(extension):
    """In digits; of keys, that it is a value which they take is seen below."""
    numbers = [(group, prop) for group, prop in shown_properties(extension) if prop.type in NUMBERS]
    numbers = [number for number in numbers if not number[1].identifier.endswith("_index")]
    silent = [f"{group}.{prop.identifier}" for group, prop in numbers if not re.search(r"\d", prop.description)]
    assert silent == []


def keys():
    return [(table, item) for table in all_tables() for item in shown_keys(table) if "number" in expected(item)]


def flat(values):
    return [inner for part in values for inner in flat(part)] if isinstance(values, list | tuple) else [values]


def test_the_tooltip_of_a_key_gives_a_value_that_it_takes():
    assert len(keys()) > 300
    for table, item in keys():
        if item.name == "values":  # they are of whatever kind the key is that varies
            continue
        value, rule = typical_value(table, item), key_of(item)
        assert value is not None, key_name(table, item)
        assert all(rule.holds(number) for number in flat(value)), key_name(table, item)


def test_no_typical_value_is_of_a_key_that_is_not_there():
    names = {
        name for table in all_tables() for item in shown_keys(table) for name in (key_name(table, item), item.name)
    }
    assert set(TYPICAL) - names == set()
