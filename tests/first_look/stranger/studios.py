"""In the manner of studios' and hobbyists' programs that the other modules leave out: figures, sculptures, renderers, game engines."""
import math

import shapes
from .games import joint, skinned
from .modellers import point
from .writer import *  # noqa: F403

CM = {"unit": "centimeter", "meter": 0.01, "up": "Y_UP"}


def camera(ident, optics):
    return f'<camera id="{ident}" name="{ident}"><optics><technique_common>{optics}</technique_common></optics></camera>'


def whole(tool, m, geometry, effects, materials, nodes, images="", lights="", cameras="", more=(), **head):
    libraries = [(n, t) for n, t in (("cameras", cameras), ("lights", lights), ("images", images)) if t]
    return collada(asset(tool, **head), [*libraries, ("effects", effects), ("materials", materials), ("geometries", geometry), *more], nodes)


@document("cinema4d/r20_studio.dae")
def c4d_r20(folder):
    """CINEMA 4D R20: ids by number, centimetres, a camera by xfov and aspect, three lights of strength 1, colours in sid'ed params."""
    m = shapes.sofa()
    fx, mats = painted(m.materials(), lambda c: col("emission", 0, 0, 0) + col("diffuse", *c) + col("specular", 0.2, 0.2, 0.2) + num("shininess", 0.5), "blinn")
    lights = point("ID10", (1, 1, 1), kind="directional") + point("ID12", (0.4, 0.4, 0.45)) + point("ID14", (0.3, 0.25, 0.2), "<falloff_angle>60</falloff_angle>", "spot")
    cam = camera("ID20", "<perspective><xfov>53.1301</xfov><aspect_ratio>1.77778</aspect_ratio><znear>1</znear><zfar>10000</zfar></perspective>")
    nodes = ('<node id="ID11" name="Infinite Light"><rotate sid="rotateY">0 1 0 30</rotate><rotate sid="rotateX">1 0 0 -45</rotate><instance_light url="#ID10"/></node>'
             '<node id="ID13" name="Light"><translate>-300 200 300</translate><instance_light url="#ID12"/></node>'
             '<node id="ID15" name="Spot"><translate>0 400 300</translate><rotate>1 0 0 -50</rotate><instance_light url="#ID14"/></node>'
             '<node id="ID21" name="Camera"><translate>250 160 420</translate><rotate>0 1 0 31</rotate><rotate>1 0 0 -14</rotate><instance_camera url="#ID20"/></node>')
    return whole("CINEMA4D 20.026 COLLADA Exporter", m, mesh("ID30", m, scaled(y_up, 100), kind="polylist"), fx, mats, nodes + place_node("ID31", "ID30", bind(m.materials())), lights=lights, cameras=cam, **CM)


@document("poser/victoria.dae")
def poser_pro(folder):
    """Poser Pro: its own unit of 2.62 m, Mac paths with colons, joints of spaced names, every material with an ambient white of 0 strength."""
    paint(folder, "SkinBody.png", lambda x, y: (215, 165 + y // 4, 140))
    m = shapes.person().moved(scale=0.38).named({"skin": "body"})
    fx = effect("body", col("emission", 0, 0, 0) + col("ambient", 1, 1, 1) + tex("diffuse", "body", "UVMapping0") + col("specular", 0.05, 0.05, 0.05) + num("shininess", 30), "phong", sampler("body"))
    more, mats = painted([n for n in m.materials() if n != "body"], lambda c: phong(c, (1, 1, 1)))
    joints = joint("Body", "Body", "", joint("Hip", "Hip", "<translate>0 0.4 0</translate>", joint("Lower_Abdomen", "Lower Abdomen", "<translate>0 0.05 0</translate>")))
    return whole("Poser Pro 2010", m, mesh("fig", m, scaled(y_up, 1)), fx + more, mats + material("body"), joints + place_node("Figure_1", "fig", bind(m.materials(), channel="UVMapping0")),
                 images=image("body", "Macintosh HD:Applications:Poser:Runtime:Textures:SkinBody.png"), unit="Poser native unit", meter=2.62128, up="Y_UP")


@document("daz/genesis.dae")
def daz_genesis(folder):
    """DAZ Studio 4.6: pictures under a path of %20s of another machine, eyes behind a cornea of A_ONE 0.05, a hidden joint tree, vendor extras everywhere."""
    paint(folder / "images", "BreeTorso.png", lambda x, y: (226, 178 + y // 5, 156))
    m = shapes.person().named({"skin": "torso", "hair": "hair"}).join(shapes.ball(0, -0.12, 1.62, 0.05, 0.05, 0.05, 10, 8, "cornea"))
    extra = '<extra><technique profile="DAZ3D"><property name="Refraction">0</property></technique></extra>'
    fx = effect("torso", tex("diffuse", "tors", "UVSet0") + col("specular", 0.4, 0.4, 0.4) + num("shininess", 8), "phong", sampler("tors"), extra)
    fx += effect("cornea", phong((1, 1, 1), specular=(1, 1, 1), shininess=90, more='<transparent opaque="A_ONE"><color>1 1 1 1</color></transparent>' + num("transparency", 0.05)))
    more, mats = painted([n for n in m.materials() if n not in ("torso", "cornea")])
    return whole("DAZ Studio 4.6.2.118", m, mesh("Genesis", m, scaled(y_up, 100), kind="polylist", normals="smooth"), fx + more, mats + material("torso") + material("cornea"),
                 place_node("Genesis-node", "Genesis", bind(m.materials(), channel="UVSet0")), images=image("tors", "file:///C:/Users/Public/Documents/My%20DAZ%203D%20Library/Runtime/textures/BreeTorso.png"), **CM)


@document("lightwave/office11.dae")
def lightwave11(folder):
    """LightWave 11: surface names with spaces as symbols, pivots, an area light as point of intensity 0.5, a light that was switched off, luminosity."""
    m = shapes.room()
    names = m.materials()
    sym = {n: f"Office {n} Surface" for n in names}
    fx, mats = painted(names, lambda c: col("emission", *(tuple(0.05 * v for v in c))) + col("diffuse", *c) + col("specular", 0, 0, 0) + num("shininess", 38.4), "phong")
    lights = point("Light", (0.5, 0.5, 0.5), "<constant_attenuation>1</constant_attenuation>") + point("Light_off", (0, 0, 0))
    nodes = '<node id="LightN"><translate>2.5 3.5 3.5</translate><instance_light url="#Light"/></node><node id="Light2N"><translate>0 1 0</translate><instance_light url="#Light_off"/></node>'
    return whole("LightWave 3D 11.0", m, mesh("Office_Layer1", m, y_up, kind="polygons", symbol=sym.get), fx, mats,
                 nodes + place_node("Office", "Office_Layer1", bind(names, sym.get), '<translate sid="pivot">0 0 0</translate><rotate>0 1 0 0</rotate>'), lights=lights, unit="meter", meter=1, up="Y_UP")


@document("unity/scene_export.dae")
def unity(folder):
    """A Unity editor script: left hand turned by a scale of -1 in the root, triangles wound for it, textures under Assets/."""
    paint(folder / "Assets/Textures", "barrel_albedo.png", "steel")
    m = shapes.barrel().named("barrel")
    flipped = shapes.Mesh()
    flipped.points = [(-p[0], p[1], p[2]) for p in m.points]
    flipped.faces = [(tuple(reversed(f)), n, tuple(reversed(uv))) for f, n, uv in m.faces]
    fx = effect("barrel", tex("diffuse", "barrel_albedo", "CHANNEL0") + col("specular", 0.1, 0.1, 0.1) + num("shininess", 0.5), "phong", sampler("barrel_albedo"))
    inner = place_node("Barrel", "Barrel-lib", bind(["barrel"], channel="CHANNEL0"), "<translate>1 0 2</translate>") + place_node("Barrel_1", "Barrel-lib", bind(["barrel"], channel="CHANNEL0"), "<translate>-0.4 0 2.5</translate>")
    return whole("Unity Collada Exporter 1.2", m, mesh("Barrel-lib", flipped, y_up, normals="smooth"), fx, material("barrel"), f'<node id="root"><matrix>-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>{inner}</node>',
                 images=image("barrel_albedo", "Assets/Textures/barrel_albedo.png"), unit="meter", meter=1, up="Y_UP")


@document("unreal/sm_pillar.dae")
def unreal3(folder):
    """UE3's exporter: centimetres, Z up, a second set for light maps, one default phong without colours, smoothing in normals."""
    m = shapes.column_temple().named("WorldGridMaterial")
    second = array("lm-uv", [(0.1 * (k % 10), 0.1 * (k // 10 % 10)) for k in range(100)], "ST")
    fx = effect("WorldGridMaterial", "", "phong")
    text = mesh("SM_Pillar", m, scaled(z_up, 100), normals="smooth", mid=second)
    return whole("Unreal Engine 3 COLLADA Exporter", m, text, fx, material("WorldGridMaterial"), place_node("SM_Pillar-node", "SM_Pillar", bind(["WorldGridMaterial"])), unit="centimeter", meter=0.01, up="Z_UP")


@document("threejs/exporter.dae")
def threejs(folder):
    """three.js ColladaExporter: all attributes in <triangles> at offset 0, colours with sids, textures in textures/, a matrix a node, MESH_MATERIAL_0."""
    paint(folder / "textures", "map_1.png", "planks")
    m = shapes.table().named("Mat1")
    points = [p for f, _, _ in triangulated(m) for p in (m.points[k] for k in f)]
    normals = [shapes.unit(m.face_normal(tuple(f))) for f, _, _ in triangulated(m) for _ in f]
    uvs = [uv for _, _, c in triangulated(m) for uv in c]
    geometry = ('<geometry id="Mesh1" name=""><mesh>' + array("Mesh1-position", [y_up(p) for p in points], "XYZ") + array("Mesh1-normal", [y_up(n) for n in normals], "XYZ") + array("Mesh1-texcoord", uvs, "ST")
                + '<vertices id="Mesh1-vertices"><input semantic="POSITION" source="#Mesh1-position" /></vertices>'
                f'<triangles material="MESH_MATERIAL_0" count="{len(points) // 3}"><input semantic="VERTEX" source="#Mesh1-vertices" offset="0" /><input semantic="NORMAL" source="#Mesh1-normal" offset="0" />'
                f'<input semantic="TEXCOORD" source="#Mesh1-texcoord" offset="0" set="0" /><p>{" ".join(str(k) for k in range(len(points)))}</p></triangles></mesh></geometry>')
    body = ('<emission><color sid="emission">0 0 0 1</color></emission><diffuse><texture texture="diffuse-sampler" texcoord="TEXCOORD" /></diffuse><specular><color sid="specular">0.06 0.06 0.06 1</color></specular>'
            '<shininess><float sid="shininess">30</float></shininess><reflective><color>0 0 0 1</color></reflective><reflectivity><float>1</float></reflectivity><transparent opaque="A_ONE"><color>1 1 1 1</color></transparent><transparency><float>1</float></transparency>')
    params = '<newparam sid="diffuse-surface"><surface type="2D"><init_from>map_1</init_from></surface></newparam><newparam sid="diffuse-sampler"><sampler2D><source>diffuse-surface</source></sampler2D></newparam>'
    fx = effect("Mat1", body, "phong", params, '<extra><technique profile="THREEJS"><double_sided>1</double_sided></technique></extra>')
    node = '<node id="Mesh1" name="Mesh1" type="NODE"><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>' + '<instance_geometry url="#Mesh1"><bind_material><technique_common><instance_material symbol="MESH_MATERIAL_0" target="#Mat1"><bind_vertex_input semantic="TEXCOORD" input_semantic="TEXCOORD" input_set="0" /></instance_material></technique_common></bind_material></instance_geometry></node>'
    return whole("three.js Collada Exporter", m, geometry, fx, material("Mat1"), node, images='<image id="map_1"><init_from>textures/map_1.png</init_from></image>', up="Y_UP", unit="meter", meter=1)


@document("houdini/cd.dae")
def houdini_cd(folder):
    """Houdini 16.5: Cd as COLOR of three in the vertices, no uv, a constant default shader whose colour is 0.8."""
    m = shapes.land(6, 16, lambda x, y: 0.5 * math.sin(x) * math.cos(y), "mat")
    text = mesh("obj_geo1-geo", m, y_up, kind="polylist", normals="vertices", uv=False, colours=lambda p: (0.3 + 0.1 * abs(p[0]), 0.5, 0.2 + 0.4 * p[2]))
    fx = effect("mat", phong((0.8, 0.8, 0.8), (0.2, 0.2, 0.2)))
    return whole("Houdini 16.5.268", m, text, fx, material("mat"), place_node("geo1", "obj_geo1-geo", bind(["mat"])), unit="meter", meter=1, up="Y_UP")


@document("zbrush/bust.dae")
def zbrush(folder):
    """ZBrush 4R8: quads, polypaint as COLOR, no material library at all, V turned, no unit, twice as wide as high by two units."""
    m = shapes.ball(0, 0, 0.4, 0.5, 0.6, 0.7, 24, 16, "PolySkin").join(shapes.ball(0, -0.6, 0.35, 0.12, 0.14, 0.12, 12, 8, "PolySkin"))
    text = mesh("PM3D_Sphere3D_1", m, y_up, kind="polylist", normals="none", symbol=None, colours=lambda p: (0.75, 0.5 + 0.1 * p[2], 0.42, 1))
    return collada(asset("Pixologic ZBrush 4R8", unit=None, up="Y_UP"), [("geometries", text)], '<node id="PM3D"><instance_geometry url="#PM3D_Sphere3D_1"/></node>')


@document("wings3d/mug.dae")
def wings(folder):
    """Wings 3D: polylists, an infinite, a point and an ambient light with 3-number colours, shininess from 0 to 1, the default material in use."""
    m = shapes.mug().named("default")
    fx = effect("default", col("emission", 0, 0, 0) + col("ambient", 0.79, 0.79, 0.79) + col("diffuse", 0.79, 0.79, 0.79) + col("specular", 0.1, 0.1, 0.1) + num("shininess", 0.2) + num("reflectivity", 0), "phong")
    lights = "".join(f'<light id="{n}"><technique_common><{k}><color>{c}</color></{k}></technique_common></light>' for n, k, c in (("inf", "directional", "0.7 0.7 0.7"), ("pt", "point", "1 1 1"), ("amb", "ambient", "0.1 0.1 0.1")))
    nodes = '<node id="i"><rotate>1 0 0 -60</rotate><instance_light url="#inf"/></node><node id="p"><translate>1 3 2</translate><instance_light url="#pt"/></node><node id="a"><instance_light url="#amb"/></node>'
    return whole("Wings3D Collada Exporter 1.5.4", m, mesh("cup", m, y_up, kind="polylist", normals="smooth"), fx, material("default"), nodes + place_node("cupN", "cup", bind(["default"])), lights=lights, unit="decimeter", meter=0.1, up="Y_UP")


@document("iclone/motion.dae")
def iclone(folder):
    """3DXchange: a skin of two joints in centimetres with a root that turns Z up, textures with %20, hair cards by an A_ONE texture."""
    m = shapes.person()
    m.points = [tuple(100 * c for c in p) for p in m.points]
    at = {"RL_BoneRoot": (0, 0, 0), "CC_Base_Spine": (0, 0, 100)}
    tree = joint("RL_BoneRoot", "RL_BoneRoot", "", joint("CC_Base_Spine", "CC_Base_Spine", "<translate>0 0 100</translate><rotate>0 0 1 25</rotate>"))
    return skinned(m, ["RL_BoneRoot", "CC_Base_Spine"], at, lambda p: "CC_Base_Spine" if p[2] > 100 else "RL_BoneRoot", tree, head=asset("iClone 3DXchange 5.51", "centimeter", 0.01), roots=("RL_BoneRoot",))


@document("torque/lods.dae")
def torque_lods(folder):
    """Torque: three details of one house lie in each other, a collision box, all below base01; hidden by nothing."""
    m = shapes.house()
    low, high = m.bounds()
    box = shapes.box(low[0], low[1], low[2], high[0], high[1], high[2], "wall")
    fx, mats = painted(m.materials(), lambert, "lambert")
    inner = place_node("house300", "h", bind(m.materials())) + place_node("house100", "h", bind(m.materials())) + place_node("Col-1", "c", bind(["wall"]), "<scale>0.9 0.9 0.9</scale>")
    return whole("Torque 3D exporter", m, mesh("h", m) + mesh("c", box), fx, mats, f'<node id="base01"><node id="start01">{inner}</node></node><node id="detail300"/><node id="detail100"/>', unit="meter", meter=1)


@document("carrara/lake.dae")
def carrara(folder):
    """Carrara 7: a sun of strength 1, feet as unit, glass of RGB_ZERO with 0.85, water with reflectivity, names with apostrophes."""
    m = shapes.ship().join(shapes.box(-8, -8, -0.6, 8, 8, -0.3, "water"))
    fx = effect("water", phong((0.1, 0.2, 0.25), more=col("reflective", 0.6, 0.6, 0.6) + num("reflectivity", 0.5) + '<transparent opaque="RGB_ZERO"><color>0.3 0.3 0.3 1</color></transparent>' + num("transparency", 1)), "blinn")
    rest = [n for n in m.materials() if n != "water"]
    more, mats = painted(rest)
    return whole("Carrara 7 Pro", m, mesh("lake", m, scaled(y_up, 3.28)), fx + more, mats + material("water"), '<node id="sun"><rotate>0 1 0 40</rotate><rotate>1 0 0 -50</rotate><instance_light url="#SunLight"/></node>' + place_node("Bob's_lake", "lake", bind(m.materials())),
                 lights=point("SunLight", (1, 1, 0.95), kind="directional"), unit="foot", meter=0.3048, up="Y_UP")


@document("modo/rover.dae", small=True)
def modo(folder):
    """modo 501: a directional light of radiance 3, a camera whose target lies far, diffuse amount folded into colours, a vendor profile beside."""
    m = shapes.rover()
    fx, mats = painted(m.materials(), lambda c: col("emission", 0, 0, 0) + col("ambient", 0, 0, 0) + col("diffuse", *(0.8 * v for v in c)) + col("specular", 0.04, 0.04, 0.04) + num("shininess", 40))
    fx = fx.replace("</effect>", '<extra><technique profile="modo401"><param sid="fresnel" type="float">1</param></technique></extra></effect>')
    cam = camera("Camera-lib", "<perspective><xfov>39.6</xfov><yfov>26.99</yfov><aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>1000</zfar></perspective>")
    nodes = ('<node id="Camera"><translate>3 2 5</translate><rotate>0 1 0 31</rotate><rotate>1 0 0 -15</rotate><instance_camera url="#Camera-lib"/></node>'
             '<node id="Sun"><rotate>0 1 0 -40</rotate><rotate>1 0 0 -45</rotate><instance_light url="#Sun-lib"/></node>')
    return whole("modo 501 [Build 44320]", m, mesh("rover", m, y_up, kind="polygons", normals="smooth"), fx, mats, nodes + place_node("roverN", "rover", bind(m.materials())), lights=point("Sun-lib", (3, 3, 3), kind="directional"), cameras=cam, unit="meter", meter=1, up="Y_UP")


@document("truespace/car.dae")
def truespace(folder):
    """trueSpace 7.6: a left-handed matrix for Z, lookat camera named View, lights of white at infinity as points far off without attenuation."""
    m = shapes.car()
    fx, mats = painted(m.materials())
    lights = "".join(point(f"Infinite{k}", c) for k, c in enumerate(((0.6, 0.6, 0.6), (0.3, 0.3, 0.35))))
    nodes = '<node id="L0"><translate>1000 -1500 2000</translate><instance_light url="#Infinite0"/></node><node id="L1"><translate>-2000 -500 1000</translate><instance_light url="#Infinite1"/></node>'
    cam = camera("View", "<perspective><yfov>40</yfov><aspect_ratio>1.333</aspect_ratio><znear>0.01</znear><zfar>1000</zfar></perspective>")
    return whole("trueSpace7.6", m, mesh("Car", m, kind="polygons"), fx, mats, nodes + '<node id="ViewN"><lookat>5 -6 3 0 0 0.6 0 0 1</lookat><instance_camera url="#View"/></node>' + place_node("CarN", "Car", bind(m.materials())), lights=lights, cameras=cam, unit="meter", meter=1)


@document("metasequoia/girl.dae")
def metasequoia(folder):
    """Metasequoia: Shift_JIS text with Japanese names, millimetres, an ambient and emission of 0.6 diffuse as its toon look has them."""
    m = shapes.person()
    names = {n: f"\u6750\u8cea{k}" for k, n in enumerate(m.materials())}
    m = m.named(names)
    fx = "".join(effect(names[n], col("emission", *(0.1 * v for v in TINTS[n])) + col("ambient", *(0.6 * v for v in TINTS[n])) + col("diffuse", *TINTS[n]), "lambert") for n in names)
    text = whole("Metasequoia 4.5", m, mesh("\u4eba", m, scaled(y_up, 1000)), fx, "".join(material(n) for n in m.materials()), place_node("\u4eba\u30ce\u30fc\u30c9", "\u4eba", bind(m.materials())), unit="mm", meter=0.001, up="Y_UP")
    return text.replace('encoding="utf-8"', 'encoding="Shift_JIS"').encode("shift_jis")


@document("spore/creature.dae")
def spore(folder):
    """Spore's creature export: _diffuse, _normal and _specular pictures, TEXTANGENT and TEXBINORMAL inputs, a joint tree without controller use."""
    for kind, tint in (("diffuse", lambda x, y: (90, 150 + y, 70)), ("normal", lambda x, y: (128, 128, 255)), ("specular", lambda x, y: (60, 60, 60))):
        paint(folder, f"Creature__{kind}.png", tint)
    m = shapes.dog().named("skin")
    tangents = array("t", [(1, 0, 0)], "XYZ") + array("b", [(0, 0, 1)], "XYZ")
    text = mesh("body", m, scaled(y_up, 1), normals="smooth", mid=tangents)
    extra = '<extra><technique profile="FCOLLADA"><bump bumptype="NORMALMAP"><texture texture="n-sampler" texcoord="TEX0"/></bump></technique></extra>'
    fx = effect("skin", col("emission", 0, 0, 0) + col("ambient", 1, 1, 1) + tex("diffuse", "d", "TEX0") + tex("specular", "s", "TEX0") + num("shininess", 20), "phong", sampler("d") + sampler("n") + sampler("s"), extra)
    return whole("Spore Creature Exporter / FCollada v3.05B", m, text, fx, material("skin"), joint("root", "root", "", joint("spine", "spine", "<translate>0 1 0</translate>")) + place_node("creature", "body", bind(["skin"], channel="TEX0")),
                 images="".join(image(k[0], f"Creature__{k}.png") for k in ("diffuse", "normal", "specular")), unit="meter", meter=1, up="Y_UP")


@document("godot/better_collada.dae")
def better_collada(folder):
    """The Better Collada exporter: ids by number, an empty sid, a point light of Blender's numbers, a skin with a root above the skeleton."""
    m = shapes.robot_arm()
    fx, mats = painted(m.materials(), lambda c: phong(c, (0, 0, 0), (0.5, 0.5, 0.5), 50, more=num("index_of_refraction", 1)), "blinn")
    light = point("id-light-9", (1, 1, 1), "<constant_attenuation>1</constant_attenuation><linear_attenuation>0</linear_attenuation><quadratic_attenuation>0.00111109</quadratic_attenuation>")
    return whole("Collada Exporter for Blender 2.5+, by Juan Linietsky (juan@codenix.com)", m, mesh("id-mesh-2", m, kind="polygons", normals="smooth"), fx, mats,
                 '<node id="id-node-8" name="Lamp"><matrix sid="transform">1 0 0 3 0 1 0 -4 0 0 1 6 0 0 0 1</matrix><instance_light url="#id-light-9"/></node>' + place_node("id-node-3", "id-mesh-2", bind(m.materials())), lights=light, unit="meter", meter=1)


@document("cheetah3d/spin.dae")
def cheetah_spin(folder):
    """Cheetah3D 6: a model that turns, keyed about one axis; the camera looks along its own -z; a light of the camera's kind called Light."""
    m = shapes.quadrotor()
    fx, mats = painted(m.materials())
    anim = ('<animation id="a">' + array("a-in", [(0,), (2,)], ["TIME"]) + array("a-out", [(0,), (360,)], ["ANGLE"]) + words("a-int", ["LINEAR", "LINEAR"], "INTERPOLATION")
            + '<sampler id="a-s"><input semantic="INPUT" source="#a-in"/><input semantic="OUTPUT" source="#a-out"/><input semantic="INTERPOLATION" source="#a-int"/></sampler><channel source="#a-s" target="q/rotateY.ANGLE"/></animation>')
    return whole("Cheetah3D 6.2", m, mesh("quad", m, y_up), fx, mats, place_node("q", "quad", bind(m.materials()), '<rotate sid="rotateY">0 1 0 0</rotate>'), more=(("animations", anim),), unit="meter", meter=1, up="Y_UP")
