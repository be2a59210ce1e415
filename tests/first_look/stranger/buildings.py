"""In the manner of architects' programs, virtual worlds, surveys and printers that the other modules leave out."""
import zipfile

import shapes
from .modellers import BOTH, INCH
from .studios import whole
from .writer import *  # noqa: F403


@document("sketchup/su6_pavilion.dae")
def sketchup6(folder):
    """Google SketchUp 6: transparent white with transparency 0 on every opaque material, a camera on a skewed matrix, lines between the faces."""
    paint(folder / "su6_pavilion", "Brick_Rough_Tan.png", "brick")
    m = shapes.column_temple()
    opaque = "<transparent><color>1 1 1 1</color></transparent>" + num("transparency", 0)
    body = lambda slot: col("emission", 0, 0, 0) + col("ambient", 0, 0, 0) + slot + col("specular", 0.33, 0.33, 0.33) + num("shininess", 20) + num("reflectivity", 0.1) + opaque  # noqa: E731
    names = m.materials()
    fx = effect(names[0], body(tex("diffuse", "Brick_Rough_Tan-image", "UVSET0")), "phong", sampler("Brick_Rough_Tan-image"))
    fx += "".join(effect(n, body(col("diffuse", *TINTS.get(n, (0.6, 0.6, 0.6))))) for n in names[1:])
    camera = '<camera id="Camera-camera"><optics><technique_common><perspective><xfov>46.666667</xfov><yfov>35</yfov><znear>1</znear><zfar>1000</zfar></perspective></technique_common></optics></camera>'
    node = '<node id="Camera"><matrix>0.89 -0.2 0.4 420 0.45 0.4 -0.8 -820 0 0.9 0.44 560 0 0 0 1</matrix><instance_camera url="#Camera-camera"/></node>'
    lines = '<lines count="2" material="edge"><input semantic="VERTEX" source="#mesh1-vtx" offset="0"/><p>0 1 1 2</p></lines>'
    return whole("Google SketchUp 6.0.1099", m, mesh("mesh1", m, scaled(z_up, INCH), more=lines), fx, "".join(material(n) for n in names), node + place_node("Model", "mesh1", bind(names, channel="UVSET0")),
                 images=image("Brick_Rough_Tan-image", "../su6_pavilion/Brick_Rough_Tan.png"), cameras=camera, unit="inch", meter=0.0254)


@document("opensim/table.dae")
def opensim(folder):
    """OpenSim's prim export: one material a face with an alpha of 1 in RGB_ONE and transparency 0.6 for the top, ids with colons and UUIDs."""
    m = shapes.table().join(shapes.block(0, 0, 0.75, 1.2, 0.8, 0.01, "pane"))
    fx = effect("pane", lambert((0.7, 0.8, 0.85), '<transparent opaque="RGB_ONE"><color>0.6 0.6 0.6 1</color></transparent>' + num("transparency", 1)), "lambert")
    more, mats = painted([n for n in m.materials() if n != "pane"], lambert, "lambert")
    uuid = "prim:5748decc-f629-461c-9a36-a35a221fe21f"
    return whole("Phoenix Firestorm", m, mesh(uuid, m), fx + more, mats + material("pane"), place_node(uuid + ":node", uuid, bind(m.materials())), unit="meter", meter=1)


@document("google_earth/backslashes.kmz")
def kmz_backslashes(folder):
    """A KMZ zipped on Windows: its members have backslashes, doc.kml lies second, the picture beside the model."""
    m = shapes.warehouse().named("side")
    fx = effect("side", tex("diffuse", "side", "UVSET0"), "lambert", sampler("side"))
    text = whole("Google SketchUp 5.0.245", m, mesh("w", m, scaled(z_up, INCH)), fx, material("side"), place_node("wn", "w", bind(["side"], channel="UVSET0")), images=image("side", "..\\images\\side.png"), unit="inch", meter=0.0254)
    kml = ('<?xml version="1.0" encoding="UTF-8"?><kml xmlns="http://earth.google.com/kml/2.0"><Placemark><LookAt><range>300</range></LookAt><Model><Location><longitude>-105.2</longitude>'
           "<latitude>40.0</latitude><altitude>0</altitude></Location><Link><href>models\\warehouse.dae</href></Link></Model></Placemark></kml>")
    paint(folder, "side.png", "brick")
    picture = folder / "side.png"
    with zipfile.ZipFile(folder / "backslashes.kmz", "w") as z:
        for name, data in (("models\\warehouse.dae", text), ("doc.kml", kml), ("images\\side.png", picture.read_bytes())):
            z.writestr(zipfile.ZipInfo(name, (2007, 1, 1, 0, 0, 0)), data)
    picture.unlink()


@document("ifc/office.dae")
def ifc_convert(folder):
    """IfcConvert: GUIDs with $ in ids, a matrix a storey, coordinates of a survey in the root, transparency 0.8 of A_ONE's alpha for windows."""
    wall, slab, pane = shapes.house(), shapes.box(-5, -4, -0.3, 5, 4, 0, "floor"), shapes.block(0, -4.5, 1.4, 2, 0.05, 1.2, "pane")
    m = wall.join(slab).join(pane)
    fx = effect("pane", phong((0.4, 0.5, 0.6), more='<transparent opaque="A_ONE"><color>1 1 1 1</color></transparent>' + num("transparency", 0.2)))
    more, mats = painted([n for n in m.materials() if n != "pane"], lambda c: col("diffuse", *c) + col("specular", 0.5, 0.5, 0.5) + num("shininess", 64))
    upper = place_node("product-2O2Fr$t4X7Zf8NOew3FLOH", "representation-33", bind(m.materials()), "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>")
    nodes = f'<node id="IfcSite"><matrix>1 0 0 2600512.25 0 1 0 1200431.75 0 0 1 431.5 0 0 0 1</matrix><node id="IfcBuildingStorey">{upper}</node></node>'
    return whole("IfcOpenShell 0.5.0-dev", m, mesh("representation-33", m, uv=False), fx + more, mats + material("pane"), nodes, unit="METRE", meter=1)


@document("chief/kitchen.dae")
def chief_architect(folder):
    """Chief Architect X6: inches, ten lamps of strength 1 without attenuation under the ceiling, pictures by absolute Windows paths in Textures."""
    paint(folder / "Textures", "Cherry.png", "planks")
    m = shapes.room().join(shapes.shelf().moved(0.5, 0.5))
    names = m.materials()
    fx = effect(names[0], tex("diffuse", "Cherry", "UV") + col("specular", 0.1, 0.1, 0.1) + num("shininess", 12), "blinn", sampler("Cherry"))
    more, mats = painted(names[1:])
    lights = "".join(f'<light id="Light{k}"><technique_common><point><color>1 1 1</color><constant_attenuation>1</constant_attenuation></point></technique_common></light>' for k in range(10))
    nodes = "".join(f'<node id="LN{k}"><translate>{(-60 + 12 * k)} {20 * (k % 3) - 20} 90</translate><instance_light url="#Light{k}"/></node>' for k in range(10))
    return whole("Chief Architect Premier X6", m, mesh("plan", m, scaled(z_up, INCH)), fx + more, material(names[0]) + mats, nodes + place_node("Plan", "plan", bind(names, channel="UV")),
                 images=image("Cherry", "C:\\ProgramData\\Chief Architect Premier X6\\Textures\\Cherry.png"), lights=lights, unit="inch", meter=0.0254)


@document("print/netfabb_gear.dae")
def netfabb(folder):
    """A printer's file: millimetres with a decimal comma, no normals, no materials, no up axis."""
    m = shapes.gear()
    head = asset("netfabb Studio 4.9", up=None).replace('meter="1"', 'meter="0,001000"').replace('name="meter"', 'name="millimeter"')
    return collada(head, [("geometries", mesh("gear", m, scaled(z_up, 40), normals="none", uv=False, symbol=None))], '<node><instance_geometry url="#gear"/></node>')


@document("vectorworks/hall.dae")
def vectorworks(folder):
    """Vectorworks 2012: layers as nested nodes, millimetres, blinn with ambient 0.2 of the diffuse, materials by layer and texture names with umlauts."""
    paint(folder, "Mauerwerk grün.png", "brick")
    m = shapes.warehouse()
    names = m.materials()
    fx = effect(names[0], col("ambient", 0.2, 0.2, 0.2) + tex("diffuse", "tex1", "UVMap") + col("specular", 0, 0, 0), "blinn", sampler("tex1"))
    more, mats = painted(names[1:], lambda c: col("ambient", *(0.2 * v for v in c)) + col("diffuse", *c), "blinn")
    nodes = f'<node id="Ebene-1" name="Konstruktionsebene-1"><node id="Klasse_Keine" name="Keine">{place_node("Objekt1", "g1", bind(names, channel="UVMap"))}</node></node>'
    return whole("Vectorworks 2012", m, mesh("g1", m, scaled(z_up, 1000)), fx + more, material(names[0]) + mats, nodes, images=image("tex1", "Mauerwerk%20gr%FCn.png"), unit="millimeter", meter=0.001)


@document("revit/lumion_tower.dae")
def lumion(folder):
    """Act-3D's Revit exporter: a library of nodes, mirrored matrices, glass by A_ONE 0.3 and both colours grey, feet, ids of numbers alone."""
    m = shapes.tower(5)
    glass = '<transparent opaque="A_ONE"><color>0.3 0.3 0.3 0.3</color></transparent>' + num("transparency", 1)
    fx, mats = painted(m.materials(), lambert, "lambert")
    fx = fx.replace(lambert(TINTS["glass"]), lambert(TINTS["glass"], glass)) if "glass" in m.materials() else fx
    library = f'<node id="100"><instance_geometry url="#1">{bind(m.materials())}</instance_geometry></node>'
    nodes = '<node id="a"><instance_node url="#100"/></node><node id="b"><matrix>-1 0 0 45 0 1 0 0 0 0 1 0 0 0 0 1</matrix><instance_node url="#100"/></node>'
    return whole("Act-3D Lumion Revit Export", m, mesh("1", m, scaled(z_up, 3.2808)), fx, mats, nodes, more=(("nodes", library),), unit="feet", meter=0.3048)


@document("archicad/villa.dae")
def archicad(folder):
    """ArchiCAD 15: only <constant> effects with emission, a sun of Y, layers as names, polygons split with holes."""
    m = shapes.house().join(shapes.tree().moved(6, 2))
    fx = "".join(effect(n, col("emission", 0, 0, 0) + col("ambient", *TINTS.get(n, (0.6, 0.6, 0.6))) + col("diffuse", *TINTS.get(n, (0.6, 0.6, 0.6))) + col("specular", 0.2, 0.2, 0.2) + num("shininess", 0.2) + num("transparency", 0), "phong") for n in m.materials())
    return whole("Graphisoft ArchiCAD 15", m, mesh("v", m, kind="polygons"), fx, "".join(material(n) for n in m.materials()), place_node("vn", "v", bind(m.materials())), unit="meter", meter=1)


@document("photoscan/quarry.dae")
def photoscan(folder):
    """Agisoft PhotoScan: a scan far from 0 in doubles of ten digits, vertex colours and one atlas, V from below, no lights."""
    paint(folder, "quarry.png", "grass")
    m = shapes.land(20, 20, shapes.hills, "material0")
    fx = effect("material0", tex("diffuse", "quarry_png", "CHANNEL0"), "constant", sampler("quarry_png"))
    text = mesh("mesh0", m, scaled(z_up, 1, (431250.5, 5412340.25, 512)), normals="smooth", digits=10)
    return whole("Agisoft PhotoScan 1.2.4", m, text, fx, material("material0"), place_node("node0", "mesh0", bind(["material0"], channel="CHANNEL0")), images=image("quarry_png", "quarry.png"), unit="meter", meter=1)


@document("deep_exploration/pump.dae")
def deep_exploration(folder):
    """Right Hemisphere: RGB_ZERO of black with transparency 0, colours repeated as ambient, an axis of Z told while Y is meant, double-sided extras."""
    m = shapes.barrel().join(shapes.bolt().moved(0.6, scale=3))
    fx, mats = painted(m.materials(), lambda c: phong(c, c, (0.3, 0.3, 0.3), 30, more='<transparent opaque="RGB_ZERO"><color>0 0 0 1</color></transparent>' + num("transparency", 0)))
    return whole("Right Hemisphere Deep Exploration 6.0", m, mesh("pump", m, y_up, kind="triangles", normals="smooth", uv=False), fx.replace("</technique></profile_COMMON>", "</technique>" + BOTH + "</profile_COMMON>"), mats,
                 place_node("pumpN", "pump", bind(m.materials())), unit="meter", meter=1)
