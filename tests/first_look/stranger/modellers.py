"""In the manner of SketchUp, 3ds Max, Maya, Blender and other modellers."""
import zipfile

import shapes
from .writer import *  # noqa: F403

INCH = 39.37
BOTH = '<extra><technique profile="GOOGLEEARTH"><double_sided>1</double_sided></technique></extra>'
FACE = '<extra><technique profile="GOOGLEEARTH"><show_cull_face>0</show_cull_face></technique></extra>'


def cut_out(x, y):
    """A person cut out of cardboard."""
    inside = (x - 32) ** 2 + (y - 10) ** 2 < 60 or (abs(x - 32) < 12 and 18 < y < 45) or (4 < abs(x - 32) < 11 and y >= 45)
    return (70, 90, 160, 255) if inside and y > 18 else (220, 180, 150, 255) if inside else (255, 255, 255, 0)


def card(width, height, name):
    m = shapes.Mesh()
    m.points = [(-width / 2, 0, 0), (width / 2, 0, 0), (width / 2, 0, height), (-width / 2, 0, height)]
    m.faces = [((0, 1, 2, 3), name, ((0, 0), (1, 0), (1, 1), (0, 1)))]
    return m


@document("sketchup/components.dae")
def sk_components(folder):
    """SketchUp 6: components as library_nodes, two of them mirrored, GOOGLEEARTH double sides, edges as lines beside triangles."""
    m = shapes.chair()
    fx = "".join(effect(n, col("emission", 0, 0, 0) + col("ambient", 0, 0, 0) + col("diffuse", *TINTS[n]), "lambert", more=BOTH) for n in m.materials())
    fx += effect("edge", col("emission", 0, 0, 0) + '<transparent opaque="A_ONE"><color>0 0 0 1</color></transparent>' + num("transparency", 1), "constant")
    edges = '<lines count="2" material="edge"><input semantic="VERTEX" source="#chair-vtx" offset="0"/><p>0 1 1 2</p></lines>'
    part = place_node("ID3", "chair", bind(m.materials() + ["edge"]))
    at = lambda s, x: f'<node name="instance_{x}"><matrix>{s} 0 0 {x} 0 1 0 0 0 0 1 0 0 0 0 1</matrix><instance_node url="#ID3"/></node>'  # noqa: E731
    return collada(
        asset("Google SketchUp 6.4.112", "inches", 0.0254), [("nodes", part), ("effects", fx), ("materials", "".join(material(n) for n in m.materials() + ["edge"])),
         ("geometries", mesh("chair", m, scaled(z_up, INCH), uv=False, more=edges))],
        f'<node name="SketchUp">{at(1, 0)}{at(-1, 40)}{at(1, 80)}{at(-1, -40)}</node>')


@document("sketchup/faceme.dae")
def sk_faceme(folder):
    """A card with a picture whose alpha cuts a person out, beside a house."""
    paint(folder / "faceme", "material_0.png", cut_out, 4)
    house, person = shapes.house(), card(1, 1.8, "mat0")
    fx, mats = painted(house.materials(), lambert, "lambert")
    fx += effect("mat0", tex("diffuse", "mat0", "UVSET0") + '<transparent opaque="A_ONE"><texture texture="mat0-sampler" texcoord="UVSET0"/></transparent>' + num("transparency", 1), "lambert", sampler("mat0"), BOTH)
    return collada(
        asset("SketchUp 8.0.15158", "inch", 0.0254), [("images", image("mat0", "faceme/material_0.png")), ("effects", fx), ("materials", mats + material("mat0")),
         ("geometries", mesh("h", house, scaled(z_up, INCH), uv=False) + mesh("p", person, scaled(z_up, INCH)))],
        place_node("hn", "h", bind(house.materials())) + place_node("pn", "p", bind(["mat0"], channel="UVSET0"), f"<translate>{-3 * INCH} {-6 * INCH} 0</translate>"))


@document("sketchup/glass_a_one.dae")
def sk_glass(folder):
    """A glass tower: A_ONE with transparency 0.35, both sides written as geometry."""
    m = shapes.block(0, 0, 6, 6, 6, 12, "pane").join(shapes.block(0, 0, 6, 2, 2, 11, "wall")).join(shapes.box(-8, -8, -0.2, 8, 8, 0, "grass"))
    fx = effect("pane", col("diffuse", 0.4, 0.6, 0.75) + '<transparent opaque="A_ONE"><color>1 1 1 1</color></transparent>' + num("transparency", 0.35), "lambert", more=BOTH)
    more, mats = painted(["wall", "grass"], lambert, "lambert")
    return collada(asset("SketchUp 7.1.4871", "inch", 0.0254), [("effects", fx + more), ("materials", mats + material("pane")), ("geometries", mesh("t", m, scaled(z_up, INCH), uv=False))],
                   place_node("tn", "t", bind(m.materials())))


@document("sketchup/interior.dae")
def sk_interior(folder):
    """A closed room, seen by the file's camera from within, no lights."""
    m = shapes.box(-3, -4, 0, 3, 4, 2.7, "wall")
    table = shapes.table().moved(0, 1)
    m.faces = [(tuple(reversed(f)), n, tuple(reversed(uv))) for f, n, uv in m.faces]
    fx, mats = painted(["wall", "wood", "metal"], lambert, "lambert")
    cam = '<camera id="cam"><optics><technique_common><perspective><yfov>60</yfov><aspect_ratio>1.6</aspect_ratio><znear>1</znear><zfar>10000</zfar></perspective></technique_common></optics></camera>'
    look = f"<lookat>{row((0, -3.8 * INCH, 1.6 * INCH, 0, 1 * INCH, 1 * INCH, 0, 0, 1))}</lookat>"
    return collada(asset("SketchUp 14.1.1283", "inch", 0.0254), [("cameras", cam), ("effects", fx), ("materials", mats), ("geometries", mesh("r", m, scaled(z_up, INCH), uv=False) + mesh("t", table, scaled(z_up, INCH), uv=False))],
                   f'<node id="c">{look}<instance_camera url="#cam"/></node>' + place_node("rn", "r", bind(["wall"])) + place_node("tn", "t", bind(["wood", "metal"])))


@document("sketchup/library.kmz")
def sk_kmz(folder):
    """A KMZ of the Warehouse: doc.kml, models/untitled.dae, images one folder up, and textures.txt."""
    m = shapes.column_temple().named({"wall": "stone"})
    fx = effect("stone", tex("diffuse", "st", "UVSET0"), "lambert", sampler("st")) + effect("roof", lambert(TINTS["roof"]), "lambert")
    text = collada(asset("Google SketchUp 7.0.8657", "meter", 0.0254), [("images", image("st", "../images/stone tile.jpg.png")), ("effects", fx), ("materials", material("stone") + material("roof")),
                   ("geometries", mesh("m", m, scaled(z_up, INCH)))], place_node("mn", "m", bind(m.materials(), channel="UVSET0")))
    paint(folder / "scrap", "a.png", "brick")
    kml = ('<?xml version="1.0" encoding="UTF-8"?><kml xmlns="http://earth.google.com/kml/2.1"><Folder><Placemark><Model><Location><longitude>8</longitude><latitude>47</latitude>'
           "<altitude>0</altitude></Location><Link><href>models/untitled.dae</href></Link></Model></Placemark></Folder></kml>")
    with zipfile.ZipFile(folder / "library.kmz", "w") as z:
        for name, data in (("doc.kml", kml), ("models/untitled.dae", text), ("textures.txt", "<stone tile.jpg.png> <../images/stone tile.jpg.png>\n"), ("images/stone tile.jpg.png", (folder / "scrap/a.png").read_bytes())):
            z.writestr(zipfile.ZipInfo(name, (2008, 1, 1, 0, 0, 0)), data)
    (folder / "scrap/a.png").unlink()
    (folder / "scrap").rmdir()


@document("max/opacity_map.dae")
def max_opacity(folder):
    """ColladaMax: foliage with an opacity map in grey without alpha, A_ONE as ColladaMax wrote it, MAX3D and FCOLLADA extras."""
    paint(folder, "leaf_colour.tga", "grass")
    paint(folder, "leaf_opacity.png", lambda x, y: (255,) * 3 + (255 if (x // 8 + y // 8) % 2 else 0,), 4)
    m = shapes.tree("leaf")
    fx = effect("leaf", col("ambient", 0.588, 0.588, 0.588) + tex("diffuse", "d", "CHANNEL1") + '<transparent opaque="A_ONE"><texture texture="o-sampler" texcoord="CHANNEL1"><extra><technique profile="MAX3D"><amount>1</amount></technique></extra></texture></transparent>' + num("transparency", 1),
                "blinn", sampler("d") + sampler("o"), '<extra><technique profile="MAX3D"><faceted>0</faceted><double_sided>1</double_sided><wireframe>0</wireframe></technique></extra>')
    more, mats = painted(["bark"])
    return collada(asset("3dsMax 9 - Feeling ColladaMax v3.05B", "meter", 1), [("images", image("d", "file:///D:/Projects/Old%20Game/tex/leaf_colour.tga") + image("o", "file:///D:/Projects/Old%20Game/tex/leaf_opacity.png")), ("effects", fx + more), ("materials", mats + material("leaf")), ("geometries", mesh("tree", m))],
                   place_node("tn", "tree", bind(m.materials(), channel="CHANNEL1")))


@document("max/fbx_rgb_zero.dae")
def max_fbx(folder):
    """FBX COLLADA exporter: RGB_ZERO, white, transparency 0."""
    m = shapes.car()
    body = lambda c: phong(c, (0.2, 0.2, 0.2), more='<transparent opaque="RGB_ZERO"><color>1 1 1 1</color></transparent>' + num("transparency", 0))  # noqa: E731
    fx, mats = painted(m.materials(), body)
    return collada(asset("FBX COLLADA exporter", "centimeter", 0.01, "Y_UP"), [("effects", fx), ("materials", mats), ("geometries", mesh("car", m, scaled(y_up, 100), normals="smooth"))], place_node("carn", "car", bind(m.materials())))


@document("max/collada13.dae", refused="COLLADA 1.3.1 is not read; 1.4.0, 1.4.1 and 1.5.0 are")
def collada13(folder):
    """COLLADA 1.3.1 as Max 7 wrote it: COMMON profile materials with params, the scene as the root's child."""
    m = shapes.crate()
    points = m.points
    tris = [c for f, _, _ in triangulated(m) for c in f]
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA version="1.3.1" xmlns="http://www.collada.org/2005/COLLADASchema">
<asset><author>me</author><authoring_tool>3dsMax7</authoring_tool><modified>2005-03-01T00:00:00Z</modified><up_axis>Z_UP</up_axis></asset>
<library type="MATERIAL"><material id="red" name="red"><shader><technique profile="COMMON"><pass><program url="PHONG">
<param name="DIFFUSE" type="float3" flow="IN">0.7 0.2 0.1</param></program></pass></technique></shader></material></library>
<library type="GEOMETRY"><geometry id="box" name="box"><mesh><source id="box-pos"><array id="box-arr" type="float" count="{3 * len(points)}">{" ".join(row(p) for p in points)}</array>
<technique profile="COMMON"><accessor source="#box-arr" count="{len(points)}" stride="3"><param name="X" type="float" flow="OUT"/><param name="Y" type="float" flow="OUT"/><param name="Z" type="float" flow="OUT"/></accessor></technique></source>
<vertices id="box-v"><input semantic="POSITION" source="#box-pos"/></vertices>
<triangles material="#red" count="{len(tris) // 3}"><input semantic="VERTEX" source="#box-v" idx="0"/><p>{" ".join(map(str, tris))}</p></triangles></mesh></geometry></library>
<scene id="s"><node id="n"><instance url="#box"/></node></scene></COLLADA>
"""


@document("max/light_map.dae")
def max_light_map(folder):
    """A baked scene: diffuse on channel 1, light map in emission on channel 2, ambient white, no lights."""
    paint(folder, "maps/floor_lm.png", lambda x, y: (40 + 2 * x, 40 + 2 * x, 50 + 2 * y, 255), 4)
    m = shapes.stairs().named("mat")
    fx = effect("mat", tex("emission", "lm", "CHANNEL2") + col("ambient", 1, 1, 1) + col("diffuse", 0.5, 0.5, 0.5), "lambert", sampler("lm"))
    b = bind(["mat"], channel="CHANNEL2", input_set=2)
    return collada(asset("OpenCOLLADA for 3ds Max", "centimeter", 0.01), [("images", image("lm", "maps/floor_lm.png")), ("effects", fx), ("materials", material("mat")), ("geometries", mesh("st", m, scaled(z_up, 100), texset=' set="2"'))], place_node("sn", "st", b))


@document("max/nan_normals.dae")
def max_nan(folder):
    """Normals of -1.#IND00, as old Max writes them of faces without area."""
    m = shapes.rover()
    fx, mats = painted(m.materials())
    text = mesh("r", m)
    head, tail = text.split('<source id="r-nrm">')
    a, b = tail.split('">', 1)
    numbers, rest = b.split("</float_array>", 1)
    values = numbers.split()
    for k in range(0, len(values), 30):
        values[k : k + 3] = ["-1.#IND00"] * 3
    text = f'{head}<source id="r-nrm">{a}">{" ".join(values)}</float_array>{rest}'
    return collada(asset("3ds Max 8"), [("effects", fx), ("materials", mats), ("geometries", text)], place_node("rn", "r", bind(m.materials())))


@document("max/reflective_zero.dae", small=True)
def max_reflective(folder):
    """Reflective white with reflectivity 0, and a mirror with a cube map that is no file."""
    m = shapes.sword()
    body = lambda c: phong(c, c, (0.9, 0.9, 0.9), 40, more=col("reflective", 1, 1, 1) + num("reflectivity", 0) + num("index_of_refraction", 1.5))  # noqa: E731
    fx, mats = painted(m.materials(), body, "blinn")
    return collada(asset("OpenCOLLADA"), [("effects", fx), ("materials", mats), ("geometries", mesh("s", m, normals="smooth"))], place_node("sn", "s", bind(m.materials())))


@document("maya/visibility.dae")
def maya_2008(folder):
    """ColladaMaya 3.05B: four cameras, Maya extras, an invisible construction box around the model, a spot light of intensity 0."""
    m, cover = shapes.ship(), shapes.block(0, 0, 3, 40, 40, 40, "wall")
    fx, mats = painted(set_of(m.materials() + ["wall"]))
    hidden = '<extra><technique profile="FCOLLADA"><visibility>0</visibility></technique></extra>'
    cams = "".join(f'<camera id="{n}Shape"><optics><technique_common>{b}</technique_common></optics></camera>' for n, b in (("persp", "<perspective><yfov>37.8493</yfov><aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>10000</zfar></perspective>"), ("top", "<orthographic><ymag>15</ymag><aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>10000</zfar></orthographic>")))
    spot = ('<light id="spotShape"><technique_common><spot><color>0 0 0</color><constant_attenuation>1</constant_attenuation><falloff_angle>40</falloff_angle></spot></technique_common></light>')
    nodes = ('<node id="persp"><translate>2800 2100 2800</translate><rotate>0 1 0 45</rotate><rotate>1 0 0 -27.9</rotate><instance_camera url="#perspShape"/></node>'
             '<node id="top"><translate>0 10001 0</translate><rotate>1 0 0 -90</rotate><instance_camera url="#topShape"/></node>'
             '<node id="spot"><instance_light url="#spotShape"/></node>')
    boxed = place_node("coverNode", "cover", bind(["wall"])).replace("</node>", hidden + "</node>")
    return collada(asset("Maya8.5 | ColladaMaya v3.05B", "centimeter", 0.01, "Y_UP"), [("cameras", cams), ("lights", spot), ("effects", fx), ("materials", mats), ("geometries", mesh("ship", m, scaled(y_up, 100), kind="polylist") + mesh("cover", cover, scaled(y_up, 100), kind="polylist"))],
                   nodes + place_node("shipNode", "ship", bind(m.materials())) + boxed)


def set_of(names):
    return list(dict.fromkeys(names))


@document("maya/fbx2011.dae")
def maya_fbx(folder):
    """Maya 2011's FBX writer: RGB_ZERO black with transparency 1, black ambient, phongs under names with namespaces."""
    m = shapes.robot_arm()
    body = lambda c: phong(c, more=col("reflective", 0, 0, 0) + num("reflectivity", 0.5) + '<transparent opaque="RGB_ZERO"><color>0 0 0 1</color></transparent>' + num("transparency", 1))  # noqa: E731
    fx, mats = painted(m.materials(), body)
    return collada(asset("FBX COLLADA exporter", "centimeter", 0.01, "Y_UP"), [("effects", fx), ("materials", mats), ("geometries", mesh("arm", m, scaled(y_up, 100), kind="polygons"))], place_node("ns_arm", "arm", bind(m.materials()), "<translate sid=\"translate\">0 0 0</translate><rotate sid=\"jointOrientY\">0 1 0 30</rotate>"))


@document("maya/blend_shapes.dae")
def maya_blend(folder):
    """A morph whose weights are all 0, then a skin of that morph that names no skeleton's joints in the scene's nodes by id."""
    m = shapes.ball(0, 0, 1, 0.5, 0.5, 0.6, 16, 10, "skin").join(shapes.ball(0, -0.5, 1, 0.1, 0.1, 0.1, 8, 6, "red"))
    wide = m.moved(scale=1.6)
    fx, mats = painted(m.materials())
    morph = '<controller id="morph"><morph source="#base" method="NORMALIZED">' + words("mt", ["wide"], "MORPH_TARGET", "IDREF") + array("mw", [(0.0,)], ["MORPH_WEIGHT"]) + '<targets><input semantic="MORPH_TARGET" source="#mt"/><input semantic="MORPH_WEIGHT" source="#mw"/></targets></morph></controller>'
    return collada(asset("Maya 2009", "centimeter", 0.01, "Y_UP"), [("effects", fx), ("materials", mats), ("geometries", mesh("base", m, scaled(y_up, 100), normals="smooth") + mesh("wide", wide, scaled(y_up, 100), normals="smooth")), ("controllers", morph)],
                   f'<node id="head"><instance_controller url="#morph">{bind(m.materials())}</instance_controller></node>')


@document("maya/holes.dae")
def maya_holes(folder):
    """A wall with a window as <ph> with <h>, beside plain polygons."""
    points = [(-3, 0, 0), (3, 0, 0), (3, 0, 4), (-3, 0, 4), (-1, 0, 1), (1, 0, 1), (1, 0, 3), (-1, 0, 3)]
    m = shapes.house()
    fx, mats = painted(set_of(m.materials() + ["paint"]), lambert, "lambert")
    wall = '<geometry id="w"><mesh>' + array("wp", [scaled(y_up, 100)(p) for p in points], "XYZ") + '<vertices id="wv"><input semantic="POSITION" source="#wp"/></vertices><polygons material="paint" count="1"><input semantic="VERTEX" source="#wv" offset="0"/><ph><p>0 1 2 3</p><h>4 7 6 5</h></ph></polygons></mesh></geometry>'
    return collada(asset("Maya 7.0 | ColladaMaya v2.01", "centimeter", 0.01, "Y_UP"), [("effects", fx), ("materials", mats), ("geometries", mesh("h", m, scaled(y_up, 100), kind="polygons") + wall)],
                   place_node("hn", "h", bind(m.materials())) + place_node("wn", "w", bind(["paint"]), "<translate>900 0 400</translate>"))


@document("maya/ambient_light_only.dae")
def maya_ambient(folder):
    """The only light is an ambient one, and the materials' ambient is black: Maya shows it lit."""
    m = shapes.dog()
    fx, mats = painted(m.materials())
    light = '<light id="ambientLightShape1"><technique_common><ambient><color>1 1 1</color></ambient></technique_common></light>'
    return collada(asset("Maya 2010", "centimeter", 0.01, "Y_UP"), [("lights", light), ("effects", fx), ("materials", mats), ("geometries", mesh("d", m, scaled(y_up, 100), normals="smooth"))],
                   place_node("dn", "d", bind(m.materials())) + '<node id="al"><instance_light url="#ambientLightShape1"/></node>')


def blender_file(m, lights, nodes, version="2.68", kind="polylist", body=phong, **ways):
    fx, mats = painted(m.materials(), body)
    return collada(asset(f"Blender {version}"), [("lights", lights), ("images", ""), ("effects", fx), ("materials", mats), ("geometries", mesh("Mesh", m, kind=kind, uv=False, **ways))],
                   nodes + place_node("Object", "Mesh", bind(m.materials())), scene="Scene")


def point(ident, rgb, more="", kind="point"):
    return f'<light id="{ident}" name="{ident}"><technique_common><{kind}><color sid="color">{row(rgb)}</color>{more}</{kind}></technique_common></light>'


@document("blender/six_lamps.dae")
def six_lamps(folder):
    """Six suns of full strength from all sides: bright, but not white all over."""
    turns = ["1 0 0 0", "1 0 0 60", "1 0 0 -60", "0 1 0 60", "0 1 0 -60", "1 0 0 180"]
    return blender_file(shapes.city(), "".join(point(f"L{i}", (1, 1, 1), kind="directional") for i in range(6)), "".join(f'<node id="N{i}"><rotate>{t}</rotate><instance_light url="#L{i}"/></node>' for i, t in enumerate(turns)))


@document("blender/camera_in_wall.dae")
def camera_in_wall(folder):
    """The camera stands within a block: it sees one flat wall from inside."""
    m = shapes.house()
    cam = '<camera id="cam"><optics><technique_common><perspective><xfov>49</xfov><aspect_ratio>1.77</aspect_ratio><znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera>'
    text = blender_file(m, point("L", (1, 1, 1)), '<node id="C"><translate>0 0 1.5</translate><instance_camera url="#cam"/></node><node id="LN"><translate>5 -8 9</translate><instance_light url="#L"/></node>')
    return text.replace("<library_lights>", f"<library_cameras>{cam}</library_cameras><library_lights>")


@document("blender/dim_lamp.dae")
def dim_lamp(folder):
    """A lamp of quadratic attenuation, far away in a scene of 100 m: everything is nearly black in its light."""
    m = shapes.bridge()
    low, high = m.bounds()
    return blender_file(m, point("L", (1, 1, 1), "<constant_attenuation>1</constant_attenuation><linear_attenuation>0</linear_attenuation><quadratic_attenuation>0.00111109</quadratic_attenuation>"), f'<node id="LN"><translate>{row((4 * high[0], -200, 150))}</translate><instance_light url="#L"/></node>')


@document("blender/illusoft249.dae")
def illusoft(folder):
    """Illusoft's script of Blender 2.49: Y up wrongly kept as Z_UP, triangles and polygons mixed, a lamp named Spot."""
    m, n = shapes.dog(), shapes.fence(6)
    fx, mats = painted(set_of(m.materials() + n.materials()))
    spot = '<light id="Spot" name="Spot"><technique_common><spot><color>1 1 1</color><constant_attenuation>1</constant_attenuation><linear_attenuation>0</linear_attenuation><quadratic_attenuation>0</quadratic_attenuation><falloff_angle>0</falloff_angle><falloff_exponent>0</falloff_exponent></spot></technique_common></light>'
    return collada(asset("Illusoft Collada 1.4.0 plugin for Blender - http://colladablender.illusoft.com", "centimeter", 0.01), [("lights", spot), ("effects", fx), ("materials", mats), ("geometries", mesh("d", m, kind="triangles") + mesh("f", n, kind="polygons"))],
                   '<node id="Spot-node" layer="L1"><translate>4 -3 6</translate><rotate>0 0 1 50</rotate><rotate>0 1 0 30</rotate><rotate>1 0 0 40</rotate><instance_light url="#Spot"/></node>' + place_node("dn", "d", bind(m.materials()), attributes=' layer="L1"') + place_node("fn", "f", bind(n.materials()), "<translate>0 1 0</translate>", ' layer="L1"'), version="1.4.0")


@document("blender/strong_emission.dae")
def strong_emission(folder):
    """Blender 2.8: emission of strength 1 in the diffuse's colour, an area lamp exported as point of no size."""
    m = shapes.desk_lamp()
    body = lambda c: col("emission", *(c if c[0] > 0.9 else (0, 0, 0))) + col("diffuse", *c) + col("reflectivity", 0, 0, 0).replace("color", "color") + num("index_of_refraction", 1.45)  # noqa: E731
    return blender_file(m, point("L", (1000, 1000, 1000)), '<node id="LN"><translate>4 -1 5.9</translate><instance_light url="#L"/></node>', "2.83", body=body)


@document("xsi/mech.dae")
def xsi(folder):
    """SOFTIMAGE|XSI: decimetres, a camera with interest as lookat, XSI extras, material symbols by number."""
    m = shapes.truck()
    fx, mats = painted(m.materials())
    cam = '<camera id="Camera-lib"><optics><technique_common><perspective><xfov>53.638</xfov><aspect_ratio>1.333333</aspect_ratio><znear>0.1</znear><zfar>32768</zfar></perspective></technique_common><technique profile="XSI"><SI_Camera><xsi_param sid="std">0</xsi_param></SI_Camera></technique></optics></camera>'
    sym = {n: f"G{i}SG" for i, n in enumerate(m.materials())}
    return collada(asset("Softimage|XSI Crosswalk 2.5", "decimeter", 0.1, "Y_UP"), [("cameras", cam), ("effects", fx), ("materials", mats), ("geometries", mesh("Truck", m, scaled(y_up, 10), kind="polylist", symbol=sym.get))],
                   '<node id="Camera"><lookat>80 60 120 0 8 0 0 1 0</lookat><instance_camera url="#Camera-lib"/></node>' + place_node("TruckN", "Truck", bind(m.materials(), sym.get), '<translate sid="trans">0 0 0</translate><rotate sid="rotation_z">0 0 1 0</rotate>'), scene="RootNode")


@document("houdini/geo.dae")
def houdini(folder):
    """Houdini: no library of materials at all, normals in vertices, polygons."""
    m = shapes.column_temple()
    return collada(asset("Houdini 9.5", "meter", 1, "Y_UP"), [("geometries", mesh("obj_geo1", m, y_up, kind="polylist", normals="vertices", uv=False, symbol=lambda s: "Default"))], place_node("geo1", "obj_geo1", ""))


@document("cinema4d/kitchen.dae")
def cinema4d(folder):
    """Cinema 4D R11: file:///Users path on a Mac, polylist, colour in emission where luminance was on."""
    paint(folder / "tex", "tiles.png", "livery")
    m = shapes.room()
    names = m.materials()
    fx = effect(names[0], tex("diffuse", "ID7", "UVSET0") + col("specular", 0.2, 0.2, 0.2) + num("shininess", 0.5), "blinn", sampler("ID7")) + painted(names[1:], lambda c: col("emission", 0, 0, 0) + col("diffuse", *c) + col("specular", 0.2, 0.2, 0.2) + num("shininess", 0.5), "blinn")[0]
    return collada(asset("CINEMA4D 11.5 COLLADA Exporter", "centimeter", 0.01, "Y_UP"), [("images", image("ID7", "file:///Users/anna/Desktop/kitchen/tex/tiles.png")), ("effects", fx), ("materials", "".join(map(material, names))), ("geometries", mesh("ID3", m, scaled(y_up, 100), kind="polylist"))],
                   place_node("ID2", "ID3", bind(names, channel="UVSET0")))


@document("lightwave/jet.dae")
def lightwave(folder):
    """LightWave: n-gons, no normals, no ids on nodes, colours only in constant ambient and diffuse 0..1."""
    m = shapes.plane()
    fx, mats = painted(m.materials(), lambda c: col("diffuse", *c), "lambert")
    return collada(asset("LightWave 9.6", "meter", 1, "Y_UP"), [("effects", fx), ("materials", mats), ("geometries", mesh("jet", m, y_up, kind="polygons", normals="none", uv=False))],
                   f'<node name="jet"><instance_geometry url="#jet">{bind(m.materials())}</instance_geometry></node>')


@document("poser/figure.dae")
def poser(folder):
    """DAZ Studio: eyelashes and hair as cards with a transparency map, skin with ambient, unit centimetre."""
    paint(folder, "textures/lash.png", lambda x, y: (20, 15, 10, 255 if x % 8 < 3 else 0), 4)
    paint(folder, "textures/face.png", lambda x, y: (225, 175 + y // 4, 150))
    m = shapes.person().named({"skin": "face"})
    m.join(card(0.5, 0.6, "lash").moved(0, -0.15, 1.2))
    fx = effect("face", col("ambient", 1, 1, 1) + tex("diffuse", "face") + col("specular", 0.1, 0.1, 0.1) + num("shininess", 10), "phong", sampler("face"))
    fx += effect("lash", col("ambient", 0, 0, 0) + tex("diffuse", "lash") + '<transparent><texture texture="lash-sampler" texcoord="UVMap"/></transparent>' + num("transparency", 1), "phong", sampler("lash"))
    rest = [n for n in m.materials() if n not in ("face", "lash")]
    more, mats = painted(rest)
    return collada(asset("DAZ Studio 3", "cm", 0.01, "Y_UP"), [("images", image("face", "./textures/face.png") + image("lash", "./textures/lash.png")), ("effects", fx + more), ("materials", mats + material("face") + material("lash")), ("geometries", mesh("fig", m, scaled(y_up, 100), normals="smooth"))],
                   place_node("fign", "fig", bind(m.materials(), channel="UVMap")))


@document("cheetah3d/lamp.dae")
def cheetah(folder):
    """Cheetah3D: init_from with a file name only and a line break, a camera and a distant light."""
    paint(folder, "wood.png", "planks")
    m = shapes.table(True).named({"wood": "w"})
    fx = effect("w", tex("diffuse", "img", "uv0"), "phong", sampler("img")) + effect("metal", phong(TINTS["metal"]))
    return collada(asset("Cheetah3D 4.6", "meter", 1, "Y_UP"), [("images", image("img", "\n\t wood.png \n")), ("effects", fx), ("materials", material("w") + material("metal")), ("geometries", mesh("t", m, y_up))], place_node("tn", "t", bind(m.materials(), channel="uv0")))
