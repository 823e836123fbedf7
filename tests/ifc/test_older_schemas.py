# SPDX-License-Identifier: GPL-3.0-or-later
"""Alignments of IFC4X1 and IFC4X2, and what stands along them, read as IFC4X3: positions and volumes by hand."""

import math

import numpy as np
import pytest
from scipy.integrate import trapezoid

from bridge_demolition_addon.ifc.alignments import curve_of
from bridge_demolition_addon.ifc.bridge import read_bridge
from bridge_demolition_addon.ifc.elements import elements_of
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.ifc.shapes import KeptShapes, shapes_of
from bridge_demolition_addon.ifc.source import open_source

ARC_M, RADIUS_M, CLOTHOID_M = 50.0, 100.0, 40.0


def written(path, more="", *, schema="IFC4X1", angle="#9=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);", heading=0.0):
    """Write a file of IFC4X1 in mm: 50 m straight, an arc of 50 m to the left, a clothoid of 40 m back to straight.

    Heights begin at 10 m, level for 60 m, and then a parabola turns upwards to 2 % over 80 m.
    """
    path.write_text(
        f"""ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','2019-02-26T09:49:25',(''),(''),'','','');
FILE_SCHEMA(('{schema}'));
ENDSEC;
DATA;
#1=IFCPROJECT('3L84P4Z5TDlhkG7NYEh7nw',$,'Alignments',$,$,$,$,(#19),#7);
#7=IFCUNITASSIGNMENT((#8,#9));
#8=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);
{angle}
#17=IFCCARTESIANPOINT((0.,0.,0.));
#18=IFCAXIS2PLACEMENT3D(#17,$,$);
#19=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#18,$);
#20=IFCCARTESIANPOINT((0.,0.));
#28=IFCSITE('3K$w1fFZr1e9WOsuVOYwqm',$,'Site',$,$,$,$,$,.ELEMENT.,$,$,$,$,$);
#29=IFCRELAGGREGATES('2s6$odNLXDUh7sR4XDOyME',$,$,$,#1,(#28));
#30=IFCALIGNMENTCURVE(#31,#41,'Road; (with signs)');
#31=IFCALIGNMENT2DHORIZONTAL($,(#32,#34,#36));
#32=IFCALIGNMENT2DHORIZONTALSEGMENT(.T.,$,$,#33);
#33=IFCLINESEGMENT2D(#20,{heading},50000.);
#34=IFCALIGNMENT2DHORIZONTALSEGMENT(.T.,$,$,#35);
#35=IFCCIRCULARARCSEGMENT2D(#38,0.,50000.,100000.,.T.);
#36=IFCALIGNMENT2DHORIZONTALSEGMENT(.T.,$,$,#37);
#37=IFCTRANSITIONCURVESEGMENT2D(#39,0.5,40000.,100000.,$,.T.,.T.,.CLOTHOIDCURVE.);
#38=IFCCARTESIANPOINT((50000.,0.));
#39=IFCCARTESIANPOINT(({1e3 * (50.0 + 100.0 * math.sin(0.5))!r},{1e5 * (1.0 - math.cos(0.5))!r}));
#41=IFCALIGNMENT2DVERTICAL((#42,#43));
#42=IFCALIGNMENT2DVERSEGLINE(.T.,$,$,0.,60000.,10000.,0.);
#43=IFCALIGNMENT2DVERSEGPARABOLICARC(.T.,$,$,60000.,80000.,10000.,0.,4000000.,.F.);
#45=IFCALIGNMENT('1$0C1DeQ19XuVt0s0v4eDb',$,'Road',$,$,$,$,#30,$);
{more}ENDSEC;
END-ISO-10303-21;
""",
        encoding="utf-8",
    )
    return path


STANDING = """#50=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,8000.,500.);
#51=IFCDISTANCEEXPRESSION(0.,0.,-250.,$,.T.);
#52=IFCDISTANCEEXPRESSION(55000.,0.,-250.,$,.T.);
#53=IFCSECTIONEDSOLIDHORIZONTAL(#30,(#50,#50),(#51,#52),.F.);
#54=IFCSHAPEREPRESENTATION(#19,'Body','AdvancedSweptSolid',(#53));
#55=IFCPRODUCTDEFINITIONSHAPE($,$,(#54));
#56=IFCLINEARPLACEMENT({0}#30,#51,$,$);
#57=IFCSLAB('0s58ppjRD6kArlU0sPu4AR',$,'Slab',$,$,#56,#55,$,$);
#60=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,1000.,2000.);
#61=IFCCARTESIANPOINT((0.,0.,-5500.));
#62=IFCAXIS2PLACEMENT3D(#61,$,$);
#63=IFCDIRECTION((0.,0.,1.));
#64=IFCEXTRUDEDAREASOLID(#60,#62,#63,5000.);
#65=IFCSHAPEREPRESENTATION(#19,'Body','SweptSolid',(#64));
#66=IFCPRODUCTDEFINITIONSHAPE($,$,(#65));
#67=IFCDISTANCEEXPRESSION(52000.,1500.,0.,$,.T.);
#68=IFCLINEARPLACEMENT({0}#30,#67,$,$);
#69=IFCPROXY('0jpcbFU3zAwvsfthsgNlOB',$,'P1','IfcColumn',$,#68,#66,.PRODUCT.,$);
#70=IFCPOLYLINE((#71,#72,#73));
#71=IFCCARTESIANPOINT((1000.,-600.));
#72=IFCCARTESIANPOINT((2000.,-600.));
#73=IFCCARTESIANPOINT((2000.,-1600.));
#74=IFCCENTERLINEPROFILEDEF(.CURVE.,$,#70,20.);
#75=IFCDISTANCEEXPRESSION(10000.,0.,0.,$,.T.);
#76=IFCDISTANCEEXPRESSION(20000.,0.,0.,$,.T.);
#77=IFCSECTIONEDSOLIDHORIZONTAL(#30,(#74,#74),(#75,#76),.F.);
#78=IFCSHAPEREPRESENTATION(#19,'Body','AdvancedSweptSolid',(#77));
#79=IFCPRODUCTDEFINITIONSHAPE($,$,(#78));
#80=IFCMEMBER('1sdvBtvOvEcvlNxpRoBBy7',$,'Angle',$,$,$,#79,$,$);
#81=IFCMATERIAL('Q345',$,'Steel');
#82=IFCELEMENTASSEMBLY('0h42DAKwDBJODiSvlv8EUa',$,'Beam',$,$,$,$,$,$,$);
#83=IFCRELAGGREGATES('3Td9kzq9T1IRLhLyx2t6EJ',$,$,$,#82,(#80));
#84=IFCRELASSOCIATESMATERIAL('3Ud9kzq9T1IRLhLyx2t6EJ',$,$,$,(#82),#81);
#85=IFCRELCONTAINEDINSPATIALSTRUCTURE('2PLGAITcT8R8LqAziBQ2jp',$,$,$,(#57,#69,#82),#28);
"""


def test_the_alignment_is_where_its_segments_lead(tmp_path):
    """The arc turns by 0.5 rad; a clothoid from R = 100 m to straight over 40 m turns by 40 / 2 / 100 = 0.2 rad more.

    The parabola: z = 10 + x² / (2 · 4000), 0.8 m higher after 80 m.
    """
    source = open_source(written(tmp_path / "a.ifc"), ImportSettings())
    assert not source.lost_classes
    (curve,) = source.model.by_type("IfcGradientCurve")
    curve = curve_of(curve, source.unit_m)
    at_end = np.array([50.0 + 100.0 * math.sin(0.5), 100.0 * (1.0 - math.cos(0.5))])
    assert curve.at(50.0).point == pytest.approx([50.0, 0.0, 10.0], abs=1e-9)
    assert curve.at(100.0).point == pytest.approx([*at_end, 10.0 + 40.0**2 / 8000.0], abs=1e-6)
    frame = curve.at(140.0 - 1e-9)
    assert frame.point[2] == pytest.approx(10.8, abs=1e-6)
    assert math.atan2(frame.along[1], frame.along[0]) == pytest.approx(0.7, abs=1e-6)
    # The clothoid by its definition: the heading after s is 0.5 + s / 100 - s² / 8000.
    way = np.linspace(0.0, 40.0, 40_001)
    heading = 0.5 + way / 100.0 - way**2 / 8000.0
    by_sum = at_end + np.array([trapezoid(np.cos(heading), way), trapezoid(np.sin(heading), way)])
    assert frame.point[:2] == pytest.approx(by_sum, abs=1e-6)


def test_angles_are_in_the_unit_of_the_file(tmp_path):
    degrees = (
        "#9=IFCCONVERSIONBASEDUNIT(#10,.PLANEANGLEUNIT.,'DEGREE',#11);\n"
        "#10=IFCDIMENSIONALEXPONENTS(0,0,0,0,0,0,0);\n"
        "#11=IFCMEASUREWITHUNIT(IFCPLANEANGLEMEASURE(0.0174532925199433),#12);\n"
        "#12=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);"
    )
    source = open_source(written(tmp_path / "a.ifc", angle=degrees, heading=90.0), ImportSettings())
    curve = curve_of(source.model.by_type("IfcGradientCurve")[0], source.unit_m)
    assert curve.at(20.0).point == pytest.approx([0.0, 20.0, 10.0], abs=1e-9)


@pytest.mark.parametrize(("schema", "within"), [("IFC4X1", ""), ("IFC4X2", "$,")])
def test_what_stands_along_it_is_where_it_should_be(schema, within, tmp_path):
    """A slab of 8 × 0.5 × 55 m, whose middle is that of the road, a column of 1 × 2 × 5 m beside it, an angle of steel.

    The slab is placed along the curve that it is swept along: that counts once. IFC4X2 has one attribute more.
    """
    source = open_source(written(tmp_path / "a.ifc", STANDING.format(within), schema=schema), ImportSettings())
    elements = [element for element in elements_of(source, ImportSettings()) if element.is_member]
    kept = KeptShapes()
    shapes = {element.facts.name: shapes_of(source, [element], kept)[element.entity.id()] for element in elements}
    assert not kept.failed
    assert {element.facts.name: element.kind for element in elements} == {
        "Slab": "deck",
        "P1": "pier",
        "Angle": "girder",
    }
    assert shapes["Slab"].volume == pytest.approx(8.0 * 0.5 * 55.0, rel=1e-4)
    assert shapes["Slab"].bounds[:, 2] == pytest.approx([9.5, 10.0], abs=1e-6)
    assert shapes["Slab"].bounds[0] == pytest.approx([0.0, -4.0, 9.5], abs=1e-6)
    column = shapes["P1"]
    middle = column.bounds.mean(axis=0)
    turned = 0.02  # 2 m along an arc of 100 m
    on_road = np.array([50.0 + 100.0 * math.sin(turned), 100.0 * (1.0 - math.cos(turned))])
    beside = 1.5 * np.array([-math.sin(turned), math.cos(turned)])
    assert middle == pytest.approx([*(on_road + beside), 10.0 - 3.0], abs=1e-6)
    assert column.volume == pytest.approx(10.0, rel=1e-9)
    # A sheet of 20 mm along a line of 1 m and 1 m has 2 · 0.02 m², whichever corner is mitred.
    assert shapes["Angle"].volume == pytest.approx(2.0 * 0.02 * 10.0, rel=1e-6)


def test_parts_have_the_material_of_their_assembly(tmp_path):
    bridge = read_bridge(written(tmp_path / "a.ifc", STANDING.format("")), ImportSettings())
    angle = next(outcome for outcome in bridge.outcomes if outcome.facts.name == "Angle")
    assert angle.substance is None or angle.substance.density_kg_m3 == pytest.approx(7850.0)
    assert any("swept along an alignment and placed along it as well are placed once" in note for note in bridge.notes)
