#!/usr/bin/env python3
"""tests/collada/deviations/make.py FOLDER: writes NN_name.dae, one for each thing
that exporters get wrong (docs/format.md). deviations_test.cpp says what each must become. The build writes them to
build/PRESET/test_data/deviations."""
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "conformance"))
from dae import *  # noqa: E402,F403
from dae import EYE_NODE, IDENTITY, INPUTS, LAMBERT, UV  # noqa: E402

TWO = ["low", "high"]


def controlled(tree, words, skeleton="<skeleton>#bone-low</skeleton>", **kinds):
    return document(tree + node(shown("#skin", kind="controller", skeleton=skeleton)),
                    controllers=skin(words, **kinds))


def no_skeleton():
    return controlled(joints(), TWO, skeleton="")


def joints_by_name():
    tree = joints().replace('sid="low"', 'name="low"').replace('sid="high"', 'name="high"')
    return controlled(tree, TWO)


def spaces_in_joint_names():
    tree = joints(names=("upper arm", "lower arm"))
    return controlled(tree, ["upper arm", "lower arm"])


def several_skeletons():
    tree = ('<node id="bone-low" sid="low" type="JOINT"/><node id="other" type="JOINT"/>'
            '<node id="bone-high" sid="high" type="JOINT"><rotate>0 0 1 25</rotate></node>')
    return controlled(tree, TWO, "<skeleton>#other</skeleton><skeleton>#bone-low</skeleton>")


def turning(*channels, steps='<rotate sid="r">0 0 1 0</rotate>', clips=""):
    return document(node(transforms=steps), animations="".join(channels), clips=clips)


def curves():
    tangents = ([(-.3, 0), (.7, 60), (1.7, 60)], [(.3, 0), (1.3, 60), (2.3, 60)])
    return turning(animated("n/r.ANGLE", [0, 1, 2], [(0,), (60,), (0,)], tangents=tangents,
                            interpolation=["BEZIER", "HERMITE", "STEP"]))


def tangent_dimensions():
    """1-D tangents; and an OUT_TANGENT source with two tangents too few."""
    good = animated("n/r.ANGLE", [0, 1], [(0,), (60,)], interpolation="BEZIER", tangents=([(20,)] * 2, [(20,)] * 2))
    bad = animated("n/t.X", [0, 1, 2], [(0,), (1,), (0,)], interpolation="BEZIER", id="b",
                   tangents=([(0, 0)] * 3, [(.3, 0)]))
    return turning(good, bad, steps='<translate sid="t">0 0 0</translate><rotate sid="r">0 0 1 0</rotate>')


def single_axes():
    steps = ('<translate sid="t">0 0 0</translate><rotate sid="rx">1 0 0 0</rotate>'
             f'<matrix sid="m">{numbers(IDENTITY)}</matrix>')
    keys, values = [0, 1], [(0,), (1,)]
    return turning(*(animated(f"n/{t}", keys, values, id=f"a{i}") for i, t in enumerate(
        ("t.X", "t(1)", "rx.ANGLE", "m(3)(2)"))), steps=steps)


def full_turns():
    return turning(animated("n/r.ANGLE", [0, 1], [(0,), (720,)]))


def pivots():
    steps = ("<translate>1 0 0</translate><translate sid=\"rotatePivot\">0 1 0</translate>"
             '<rotate sid="jointOrientX">1 0 0 30</rotate><rotate sid="r">0 0 1 0</rotate>'
             '<translate sid="rotatePivotInverse">0 -1 0</translate><translate sid="scalePivot">0 .5 0</translate>'
             '<scale sid="s">1 2 1</scale><translate sid="scalePivotInverse">0 -.5 0</translate>')
    return turning(animated("n/r.ANGLE", [0, 1], [(0,), (90,)]), steps=steps)


def clips():
    first = animated("n/r.ANGLE", [0, 1], [(0,), (90,)])
    loose = animated("n/t.X", [0, 4], [(0,), (1,)], id="b")
    return turning(first, loose, steps='<translate sid="t">0 0 0</translate><rotate sid="r">0 0 1 0</rotate>',
                   clips='<animation_clip id="wave" start="1" end="0.5"><instance_animation url="#a"/>'
                         "</animation_clip>")


def up_axis():
    return plain().replace("<up_axis>Y_UP</up_axis>", "")


def units():
    return plain(unit='name="centimeter" meter="1.0"')


def transparency():
    return plain(effects=effect('<phong><diffuse><color>.8 .5 .2 1</color></diffuse><transparent opaque="RGB_ZERO">'
                                "<color>1 1 1 1</color></transparent><transparency><float>1</float></transparency>"
                                "</phong>"))


def direct_image():
    return textured(texture='<texture texture="map"/>', path="map.png")


def no_vertex_input():
    second = source("house-t2", UVS, "ST")
    mesh = geometry().replace("<vertices", second + "<vertices").replace(
        'set="0"/>', 'set="2"/><input semantic="TEXCOORD" source="#house-t2" offset="2" set="7"/>')
    asks_for_5 = UV.replace('"UV"', '"CHANNEL7"').replace('input_set="0"', 'input_set="5"')
    other = node(shown(inside=bind(asks_for_5, "other")), id="n2")
    return textured(texture='<texture texture="map-sampler" texcoord="CHANNEL7"/>', inside="", geometries=mesh,
                    materials=material() + material("other")).replace("</visual_scene>", other + "</visual_scene>")


def materials():
    """One node binds another symbol than the primitives have, one nothing at all."""
    return document(node(shown(inside=bind(symbol="nobody")))
                    + node('<instance_geometry url="#house"/>', id="n2"))


def image_paths():
    uris = ["file:///C:/Users/artist/Map.png", "file://map.png", "textures\\map.png", "%6Dap.png",
            "<![CDATA[map.png]]>", "map.tga", "nowhere.png"]
    images = "".join(f'<image id="map{i}"><init_from>{uri}</init_from></image>\n' for i, uri in enumerate(uris))
    effects = "".join(texture_effect(id=f"fx{i}").replace(">map<", f">map{i}<") for i in range(len(uris)))
    mats = "".join(material(f"mat{i}", f"fx{i}") for i in range(len(uris)))
    nodes = "".join(node(shown(inside=bind(UV, f"mat{i}")), id=f"n{i}") for i in range(len(uris)))
    return document(nodes, images=images, effects=effects, materials=mats)


def empty_primitives():
    start = INPUTS.format("house")
    return plain(geometries=geometry(
        triangles() + f'<triangles count="0" material="m">{start}<p></p></triangles>'
        f'<triangles count="0" material="m">{start}</triangles>'
        f'<polylist count="2" material="m">{start}<vcount>2 3</vcount><p>0 0 0 1 0 1 0 0 0 1 0 1 2 0 2</p></polylist>'
        f'<polygons count="1" material="m">{start}<p>0 0 0 1 0 1</p></polygons>'))


def concave():
    points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (0, 0, 0), (-1, 1, 0),
              (-.6, -.6, 0), (.6, -.6, 0), (0, -.2, 0)]
    mesh = (source("house-p", points, "XYZ")
            + '<vertices id="house-v"><input semantic="POSITION" source="#house-p"/></vertices>')
    one = '<input semantic="VERTEX" source="#house-v" offset="0"/>'
    return plain(geometries=f'<geometry id="house"><mesh>{mesh}<polygons count="2" material="m">{one}<p>0 1 2 3 4</p>'
                 f'<ph><p>0 1 2 3 4</p><h>5 7 6</h></ph></polygons><tristrips count="1" material="m">{one}'
                 "<p>0 1 4 3</p></tristrips></mesh></geometry>")


def shared_offsets():
    points = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]
    mesh = (source("house-p", points, "XYZ") + source("house-n", [(0, 0, 1)] * 3, "XYZ")
            + source("house-c", [(1, 0, 0), (0, 1, 0), (0, 0, 1)], "RGB")
            + source("house-t", [(0, 0), (1, 0), (0, 1)], "ST")
            + '<vertices id="house-v"><input semantic="POSITION" source="#house-p"/><input semantic="NORMAL" '
              'source="#house-n"/><input semantic="COLOR" source="#house-c"/></vertices>')
    return plain(geometries=f'<geometry id="house"><mesh>{mesh}<triangles count="1" material="m"><input '
                 'semantic="VERTEX" source="#house-v" offset="0"/><input semantic="TEXCOORD" source="#house-t" '
                 'offset="0" set="0"/><p>0 1 2</p></triangles></mesh></geometry>')


def order():
    """An empty library, cameras after the scene, an attribute nobody knows."""
    text = plain()
    at, end = text.index("<library_cameras>"), text.index("</library_cameras>") + len("</library_cameras>\n")
    cameras = text[at:end]
    text = text[:at] + "<library_images/>\n" + text[end:].replace('<node id="n">', '<node id="n" blend="1">')
    return text.replace("</COLLADA>", cameras + "</COLLADA>")


def ids():
    """Two elements of one id and different kinds, an id with a space, a mesh without one."""
    text = plain().replace('id="mat"', 'id="house"').replace("#mat", "#house")
    return text.replace('id="eye"', 'id="my eye"').replace("#eye", "#my eye").replace(
        "</library_geometries>", "<geometry><mesh/></geometry></library_geometries>")


def number_forms():
    """Decimal commas, NaN, a count of two billion, a negative index."""
    text = geometry(triangles().replace("</p>", " -1 0 0 1 0 0 2 0 0</p>").replace('count="16"', 'count="17"'))
    text = text.replace('count="30">', 'count="2000000000">', 1).replace("-0.6 -0.5 0.3", "-0,6 -0,5 0,3", 1)
    text = text.replace("0 1 0 ", "NaN 1.#QNAN 0 ", 1)
    return plain(geometries=text)


def cameras():
    """xfov alone, with an aspect, both, orthographic with one size, and nothing."""
    kinds = ["<perspective><xfov>50</xfov>{}</perspective>",
             "<perspective><xfov>50</xfov><aspect_ratio>2</aspect_ratio>{}</perspective>",
             "<perspective><xfov>50</xfov><yfov>30</yfov>{}</perspective>",
             "<orthographic><xmag>2</xmag>{}</orthographic>", "<perspective>{}</perspective>"]
    clip = "<znear>.1</znear><zfar>100</zfar>"
    cams = "".join(camera(kind.format(clip), f"eye{i}") for i, kind in enumerate(kinds))
    nodes = "".join(EYE_NODE.replace("eye-node", f"eye-node{i}").replace("#eye", f"#eye{i}")
                    for i in range(len(kinds)))
    return plain(cameras=cams, eye=nodes)


def extras():
    """double_sided, bump and wrapU of vendors, and one that nobody draws."""
    placed = ('<texture texture="map-sampler" texcoord="UV"><extra><technique profile="MAYA"><wrapU>0</wrapU>'
              "<wrapV>1</wrapV><repeatU>2</repeatU><repeatV>3</repeatV></technique></extra></texture>")
    extra = ('<extra><technique profile="FCOLLADA"><bump><texture texture="map-sampler" texcoord="UV"><extra>'
             '<technique profile="MAX3D"><amount>0.5</amount></technique></extra></texture></bump></technique>'
             '<technique profile="GOOGLEEARTH"><double_sided>0</double_sided></technique>'
             '<technique profile="NOBODY"><glitter>1</glitter></technique></extra>')
    return textured(texture=placed, extra=extra)


ROWS = [no_skeleton, joints_by_name, spaces_in_joint_names, several_skeletons, curves, tangent_dimensions,
        single_axes, full_turns, pivots, clips, up_axis, units, transparency, direct_image, no_vertex_input,
        materials, image_paths, empty_primitives, concave, shared_offsets, order, ids, number_forms, cameras, extras]


def main():
    folder = Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for number, row in enumerate(ROWS, 1):
        (folder / f"{number:02}_{row.__name__}.dae").write_text(row())
    (folder / "map.png").write_bytes(png(picture()))
    print(f"{len(ROWS)} files in {folder}")


if __name__ == "__main__":
    main()
