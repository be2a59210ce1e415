"""In the manner of games' assets, virtual worlds, scanners and of documents that went through many hands."""
import math

import shapes
from .modellers import card, set_of
from .writer import *  # noqa: F403

ONE = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)


def skinned(m, names, at, joint_of, tree, place=z_up, shape=ONE, kind="Name", head=None, body=phong, normals="smooth", inverse=None, roots=("Bip01",), transforms=""):
    """A document of a skin with one joint a point. at: joint -> origin in the skin's units."""
    fx, mats = painted(m.materials(), body)
    binds = inverse or [(1, 0, 0, -x, 0, 1, 0, -y, 0, 0, 1, -z, 0, 0, 0, 1) for x, y, z in (at[n] for n in names)]
    n = len(m.points)
    skin = (f'<controller id="skin"><skin source="#body"><bind_shape_matrix>{row(shape)}</bind_shape_matrix>' + words("sj", names, "JOINT", kind) + matrices("sb", binds) + array("sw", [(1.0,)], ["WEIGHT"])
            + '<joints><input semantic="JOINT" source="#sj"/><input semantic="INV_BIND_MATRIX" source="#sb"/></joints>'
            f'<vertex_weights count="{n}"><input semantic="JOINT" source="#sj" offset="0"/><input semantic="WEIGHT" source="#sw" offset="1"/><vcount>{" ".join("1" * n)}</vcount>'
            f'<v>{" ".join(f"{names.index(joint_of(p))} 0" for p in m.points)}</v></vertex_weights></skin></controller>')
    instance = f'<node id="bodyNode">{transforms}<instance_controller url="#skin">{"".join(f"<skeleton>#{r}</skeleton>" for r in roots)}{bind(m.materials())}</instance_controller></node>'
    return collada(head or asset("Blender 2.71"), [("effects", fx), ("materials", mats), ("geometries", mesh("body", m, place, normals=normals, uv=False)), ("controllers", skin)], tree + instance)


def joint(ident, sid, transforms, inner=""):
    return f'<node id="{ident}" sid="{sid}" name="{ident}" type="JOINT">{transforms}{inner}</node>'


def half(p):
    return "chest" if p[2] > 1 else "pelvis"


@document("secondlife/avatar.dae")
def sl_avatar(folder):
    """A rigged upload: mPelvis and mChest with scales in their nodes, which the inverse binds undo; the bind shape turns and scales."""
    tree = joint("mPelvis", "mPelvis", "<matrix>2 0 0 0 0 2 0 0 0 0 2 1 0 0 0 1</matrix>", joint("mChest", "mChest", "<matrix>0.5 0 0 0 0 0.5 0 0 0 0 0.5 0.1 0 0 0 1</matrix>"))
    inverse = [(0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, -0.5, 0, 0, 0, 1), (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -1.2, 0, 0, 0, 1)]
    shape = (0, -0.01, 0, 0, 0.01, 0, 0, 0, 0, 0, 0.01, 0, 0, 0, 0, 1)
    return skinned(shapes.person(), ["mPelvis", "mChest"], {}, lambda p: "mChest" if p[2] > 1.1 else "mPelvis", tree, scaled(z_up, 100), shape, inverse=inverse, roots=("mPelvis",), head=asset("Blender 2.69, Second Life export"))


@document("secondlife/prims.dae")
def sl_prims(folder):
    """Eight material faces, ids with spaces and dots, the url escaped."""
    m = shapes.desk_lamp().moved(0).join(shapes.crate().moved(0.8))
    fx, mats = painted(m.materials(), lambert, "lambert")
    return collada(asset("Singularity Viewer", "meter", 1), [("effects", fx), ("materials", mats), ("geometries", mesh("Object 1.002-mesh", m))], place_node("Object 1.002", "Object%201.002-mesh", bind(m.materials())))


@document("torque/orc.dae")
def bind_pose_differs(folder):
    """The joints stand elsewhere than at binding: the figure bends forward by 40 degrees, feet together."""
    tree = joint("Bip01", "pelvis", "<translate>0 0 1</translate>", joint("Bip01_Spine", "chest", "<rotate>1 0 0 40</rotate>"))
    return skinned(shapes.person(), ["pelvis", "chest"], {"pelvis": (0, 0, 1), "chest": (0, 0, 1)}, half, tree, head=asset("Torque exporter"))


@document("games/idref_joints.dae")
def idref_joints(folder):
    """IDREF_array of joint ids, two skeletons, the skin's node below a scaled armature whose transform does not count."""
    tree = '<node id="Armature"><scale>100 100 100</scale>' + joint("hip", "a", "<translate>0 0 0.01</translate>") + "</node>" + joint("top", "b", "<translate>0 0 1.4</translate>")
    inverse = [(0.01, 0, 0, 0, 0, 0.01, 0, 0, 0, 0, 0.01, -0.01, 0, 0, 0, 1), (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -1.4, 0, 0, 0, 1)]
    return skinned(shapes.dog(), ["hip", "top"], {}, lambda p: "top" if p[2] > 0.6 else "hip", tree, kind="IDREF", inverse=inverse, roots=("hip", "top"), transforms="<translate>500 0 0</translate><scale>100 100 100</scale>")


@document("games/vertex_colours_only.dae")
def only_colours(folder):
    """No normals, no materials, colours of vertices in bytes/255 with alpha 0, as some exporters leave it."""
    m = shapes.land(40, 12, shapes.hills, "x")
    return collada(asset("Terrain tool", None, up=None), [("geometries", mesh("land", m, y_up, normals="none", uv=False, symbol=None, colours=lambda p: (0.3 + p[2] / 20, 0.5, 0.25, 0)))], place_node("n", "land", ""))


@document("games/profile_cg.dae")
def profile_cg(folder):
    """COLLADA 1.4.0 of the PS3 days: profile_CG first, the COMMON fallback behind it."""
    m = shapes.barrel().named("drum")
    cg = '<profile_CG><include sid="inc" url="./drum.cgfx"/><technique sid="t0"><pass sid="p0"><shader stage="VERTEX"><compiler_target>arbvp1</compiler_target><name source="inc">vs_main</name></shader></pass></technique></profile_CG>'
    fx = effect("drum", phong((0.1, 0.3, 0.6))).replace("<profile_COMMON>", cg + "<profile_COMMON>")
    return collada(asset("FX Composer 1.8", "meter", 1, "Y_UP"), [("effects", fx), ("materials", material("drum")), ("geometries", mesh("d", m, y_up))], place_node("dn", "d", bind(["drum"])), version="1.4.0")


@document("games/profile_glsl_only.dae")
def profile_glsl(folder):
    """An effect of profile_GLSL alone: the model is shown in a plain colour."""
    m = shapes.gear().named("gear")
    fx = '<effect id="gear-effect"><profile_GLSL><technique sid="default"><pass><states/></pass></technique></profile_GLSL></effect>'
    return collada(asset("NVIDIA FX Composer 2.5", "meter", 1, "Y_UP"), [("effects", fx), ("materials", material("gear")), ("geometries", mesh("g", m, y_up))], place_node("gn", "g", bind(["gear"])))


@document("games/strips.dae", least=0.12)
def strips(folder):
    """Tristrips and trifans with lines beside them, all of one material."""
    n, pts, strip = 24, [], []
    for k in range(n + 1):
        a = 2 * math.pi * k / n
        pts += [(math.cos(a), math.sin(a), 0), (math.cos(a), math.sin(a), 1.5)]
        strip += [2 * k + 1, 2 * k]
    base = len(pts)
    pts += [(0, 0, 1.5)]
    fan = [base] + [2 * k + 1 for k in range(n + 1)]
    inp = '<input semantic="VERTEX" source="#v" offset="0"/>'
    text = f'<geometry id="g"><mesh>{array("p", pts, "XYZ")}<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><tristrips count="1" material="m">{inp}<p>{row(strip)}</p></tristrips><trifans count="1" material="m">{inp}<p>{row(fan)}</p></trifans><linestrips count="1" material="m">{inp}<p>0 2 4 6</p></linestrips></mesh></geometry>'
    return collada(asset("PSSG"), [("effects", effect("m", phong((0.6, 0.5, 0.2)))), ("materials", material("m")), ("geometries", text)], place_node("gn", "g", bind(["m"])))


@document("games/emission_texture.dae")
def emission_texture(folder):
    """Diffuse is black, and the picture is in emission: unlit as the author saw it."""
    paint(folder, "sky.png", lambda x, y: (90 + y, 120 + y, 200))
    m = shapes.ball(0, 0, 0, 10, 10, 10, 24, 16, "sky")
    fx = effect("sky", tex("emission", "sky") + col("ambient", 0, 0, 0) + col("diffuse", 0, 0, 0), "lambert", sampler("sky"))
    return collada(asset("Unity", "centimeter", 0.01, "Y_UP"), [("images", image("sky", "sky.png")), ("effects", fx), ("materials", material("sky")), ("geometries", mesh("s", m, y_up))], place_node("sn", "s", bind(["sky"], channel="UVMap")))


@document("games/ambient_materials.dae")
def ambient_materials(folder):
    """The colour stands in ambient alone; diffuse is black."""
    m = shapes.sofa()
    fx, mats = painted(m.materials(), lambda c: col("emission", 0, 0, 0) + col("ambient", *c) + col("diffuse", 0, 0, 0))
    return collada(asset("Deep Exploration 5", "meter", 1, "Y_UP"), [("effects", fx), ("materials", mats), ("geometries", mesh("s", m, y_up))], place_node("sn", "s", bind(m.materials())))


@document("games/material_animation.dae")
def material_animation(folder):
    """Only materials are animated: transparency from 1 to 0 and diffuse by component."""
    m = shapes.mug()
    names = m.materials()
    fx = "".join(effect(n, '<diffuse><color sid="diffuse">0.6 0.3 0.2 1</color></diffuse><transparent opaque="A_ONE"><color>1 1 1 1</color></transparent><transparency><float sid="transparency">1</float></transparency>') for n in names)
    anim = ('<animation id="a">' + array("ai", [(0.0,), (2.0,)], ["TIME"]) + array("ao", [(1.0,), (0.0,)], ["TRANSPARENCY"]) + words("ap", ["LINEAR", "LINEAR"], "INTERPOLATION")
            + '<sampler id="as"><input semantic="INPUT" source="#ai"/><input semantic="OUTPUT" source="#ao"/><input semantic="INTERPOLATION" source="#ap"/></sampler>'
            f'<channel source="#as" target="{names[0]}-effect/transparency/transparency"/></animation>')
    return collada(asset("Maya", "centimeter", 0.01, "Y_UP"), [("animations", anim), ("effects", fx), ("materials", "".join(map(material, names))), ("geometries", mesh("mug", m, scaled(y_up, 100)))], place_node("mn", "mug", bind(names)))


@document("games/far_away.dae")
def far_away(folder):
    """A house 400 km from the origin in its node, 2 km in its mesh."""
    m = shapes.house()
    fx, mats = painted(m.materials(), lambert, "lambert")
    return collada(asset("CityEngine", "meter", 1), [("effects", fx), ("materials", mats), ("geometries", mesh("h", m, scaled(z_up, 1, (2000, -1500, 300)), digits=9))], place_node("hn", "h", bind(m.materials()), "<translate>400000 5200000 0</translate>"))


@document("games/tiny.dae")
def tiny(folder):
    """A molecule in metres: 2e-9 across."""
    m = lumps().named("red").moved(scale=1e-9)
    fx, mats = painted(["red"])
    return collada(asset("Chimera"), [("effects", fx), ("materials", mats), ("geometries", mesh("m", m, normals="smooth"))], place_node("mn", "m", bind(["red"])))


@document("games/outlier.dae")
def outlier(folder):
    """One stray point, which no face uses, lies 10 km away."""
    m = shapes.tree()
    m.points.append((10000.0, 10000.0, 0.0))
    fx, mats = painted(m.materials(), lambert, "lambert")
    return collada(asset("Wings 3D"), [("effects", fx), ("materials", mats), ("geometries", mesh("t", m))], place_node("tn", "t", bind(m.materials())))


@document("games/direct_texture.dae")
def direct_texture(folder):
    """<texture> names the file itself, without image, surface and sampler."""
    paint(folder, "bricks.png", "brick")
    m = shapes.warehouse().named("w")
    fx = effect("w", '<diffuse><texture texture="bricks.png" texcoord="TEX0"/></diffuse>', "lambert")
    return collada(asset("own exporter", "meter", 1), [("effects", fx), ("materials", material("w")), ("geometries", mesh("w0", m))], place_node("wn", "w0", bind(["w"])))


@document("games/no_hash.dae")
def no_hash(folder):
    """Links without the number sign, CRLF, and a byte order mark."""
    m = shapes.crate()
    fx, mats = painted(m.materials(), lambert, "lambert")
    text = collada(asset("my exporter"), [("effects", fx), ("materials", mats), ("geometries", mesh("c", m))], place_node("cn", "c", bind(m.materials())))
    return b"\xef\xbb\xbf" + text.replace('url="#', 'url="').replace("\n", "\r\n").encode()


@document("games/utf16.dae")
def utf16(folder):
    """UTF-16 with its mark, names in Chinese."""
    m = shapes.bottle()
    fx, mats = painted(m.materials())
    text = collada(asset("导出"), [("effects", fx), ("materials", mats), ("geometries", mesh("瓶子", m, normals="smooth"))], place_node("节点", "瓶子", bind(m.materials())))
    return text.replace("utf-8", "utf-16").encode("utf-16")


@document("games/two_channels.dae")
def two_channels(folder):
    """The effect's texcoord names no bound vertex input; the mesh has sets 0 and 1."""
    paint(folder, "floor.png", "planks")
    m = shapes.stairs().named("s")
    text = mesh("st", m).replace('<input semantic="TEXCOORD" source="#st-uv" offset="2" set="0"/>', '<input semantic="TEXCOORD" source="#st-uv" offset="2" set="0"/><input semantic="TEXCOORD" source="#st-uv" offset="2" set="1"/>')
    fx = effect("s", tex("diffuse", "f", "TEX0"), "lambert", sampler("f"))
    return collada(asset("Unreal"), [("images", image("f", ".\\floor.png")), ("effects", fx), ("materials", material("s")), ("geometries", text)], place_node("sn", "st", bind(["s"])))


@document("games/missing_picture.dae", missing=True)
def missing_picture(folder):
    """The picture is lost: the shape must still be seen as one sees shapes."""
    m = shapes.person()
    names = m.materials()
    fx = effect(names[0], tex("diffuse", "gone"), "lambert", sampler("gone")) + painted(names[1:], lambert, "lambert")[0]
    return collada(asset("Milkshape"), [("images", image("gone", "C:\\Documents and Settings\\Bob\\My Documents\\gone.jpg")), ("effects", fx), ("materials", "".join(map(material, names))), ("geometries", mesh("p", m, normals="smooth"))], place_node("pn", "p", bind(names, channel="UVMap")))


@document("games/fireflies.dae")
def glow_cards(folder):
    """Additive effect cards: black diffuse, white transparent of RGB_ONE, beside a lantern of metal."""
    m = shapes.desk_lamp().join(card(0.3, 0.3, "halo").moved(-0.1, -0.1, 0.3))
    rest = [n for n in m.materials() if n != "halo"]
    fx, mats = painted(rest)
    fx += effect("halo", col("emission", 1, 0.9, 0.5) + col("diffuse", 0, 0, 0) + '<transparent opaque="RGB_ONE"><color>0.3 0.3 0.3 1</color></transparent>' + num("transparency", 1), "lambert")
    return collada(asset("Ogre exporter"), [("effects", fx), ("materials", mats + material("halo")), ("geometries", mesh("l", m))], place_node("ln", "l", bind(m.materials())))


@document("games/floor_huge.dae")
def huge_floor(folder):
    """A car on a ground plane of 200 m, as one renders turntables: the car is small but seen."""
    m = shapes.car().join(shapes.box(-40, -40, -0.1, 40, 40, 0, "floor"))
    fx, mats = painted(set_of(m.materials()))
    return collada(asset("modo 401", "meter", 1, "Y_UP"), [("effects", fx), ("materials", mats), ("geometries", mesh("c", m, y_up))], place_node("cn", "c", bind(m.materials())))


@document("games/sky_dome.dae")
def sky_dome(folder):
    """A village within a sky dome seen from outside: no camera, no light."""
    paint(folder, "dome.png", lambda x, y: (120, 150 + y, 230))
    m = shapes.house()
    dome = shapes.ball(0, 0, 0, 60, 60, 60, 20, 12, "sky")
    dome.faces = [(tuple(reversed(f)), n, tuple(reversed(uv))) for f, n, uv in dome.faces]
    fx, mats = painted(m.materials(), lambert, "lambert")
    fx += effect("sky", tex("emission", "dome"), "constant", sampler("dome"))
    return collada(asset("Blender 2.62"), [("images", image("dome", "dome.png")), ("effects", fx), ("materials", mats + material("sky")), ("geometries", mesh("h", m) + mesh("d", dome))],
                   place_node("hn", "h", bind(m.materials())) + place_node("dn", "d", bind(["sky"], channel="UVMap")))


@document("games/convex.dae")
def convex(folder):
    """convex_mesh with faces of its own, and a second that names its hull's source alone."""
    m = shapes.crate()
    fx, mats = painted(m.materials())
    hull = '<geometry id="hull"><convex_mesh convex_hull_of="#c"/></geometry>'
    return collada(asset("Bullet"), [("effects", fx), ("materials", mats), ("geometries", mesh("c", m, wrap="convex_mesh") + hull)], place_node("cn", "c", bind(m.materials())) + '<node id="hn"><instance_geometry url="#hull"/></node>')


@document("games/grows_from_nothing.dae", small=True)
def grows(folder):
    """The model grows from scale 0 within the first second; it is there at its second key."""
    m = shapes.tree()
    fx, mats = painted(m.materials(), lambert, "lambert")
    rock = shapes.ball(1.5, 0, 0.5, 0.8, 0.7, 0.5, 10, 6, "wall")
    more, rocks = painted(["wall"], lambert, "lambert")
    anim = ('<animation id="a">' + array("ai", [(0.0,), (1.0,)], ["TIME"]) + array("ao", [(0.0,) * 3, (1.0,) * 3], "XYZ") + words("ap", ["LINEAR", "LINEAR"], "INTERPOLATION")
            + '<sampler id="as"><input semantic="INPUT" source="#ai"/><input semantic="OUTPUT" source="#ao"/><input semantic="INTERPOLATION" source="#ap"/></sampler><channel source="#as" target="tn/scale"/></animation>')
    return collada(asset("Blender 2.70"), [("animations", anim), ("effects", fx + more), ("materials", mats + rocks), ("geometries", mesh("t", m) + mesh("r", rock))], place_node("tn", "t", bind(m.materials()), '<scale sid="scale">1 1 1</scale>') + place_node("rn", "r", bind(["wall"])))


@document("makehuman/base.dae")
def makehuman(folder):
    """MakeHuman: decimetres, joints of no transform but a matrix, weights that do not sum to one."""
    tree = joint("Bip01", "pelvis", f"<matrix>{row(ONE)}</matrix>", joint("Chest", "chest", "<matrix>1 0 0 0 0 1 0 10 0 0 1 0 0 0 0 1</matrix>"))
    text = skinned(shapes.person(1.2), ["pelvis", "chest"], {"pelvis": (0, 0, 0), "chest": (0, 10, 0)}, half, tree, scaled(y_up, 10), head=asset("MakeHuman 1.0 alpha 6", "decimeter", 0.1, "Y_UP"))
    return text.replace('<float_array id="sw-array" count="1">1<', '<float_array id="sw-array" count="1">0.5<')


@document("games/hex_15.dae")
def fifteen(folder):
    """COLLADA 1.5: sampler2D with instance_image, an image of <ref>, the texture below a newparam of the effect."""
    paint(folder, "fifteen.png", "fabric")
    m = shapes.chair().named("c")
    fx = '<effect id="c-effect"><newparam sid="smp"><sampler2D><instance_image url="#im"/></sampler2D></newparam><profile_COMMON><technique sid="t"><lambert><diffuse><texture texture="smp" texcoord="T"/></diffuse></lambert></technique></profile_COMMON></effect>'
    return collada(asset("own 1.5", "meter", 1, "Z_UP"), [("images", '<image id="im"><init_from><ref>fifteen.png</ref></init_from></image>'), ("effects", fx), ("materials", material("c")), ("geometries", mesh("g", m))], place_node("n", "g", bind(["c"], channel="T")), version="1.5.0")


@document("games/wrong_up.dae")
def wrong_up(folder):
    """No up axis and no unit: the defaults of the format are Y up and metres."""
    m = shapes.tower()
    fx, mats = painted(m.materials(), lambert, "lambert")
    return collada(asset("x", None, up=None), [("effects", fx), ("materials", mats), ("geometries", mesh("t", m, y_up))], place_node("tn", "t", bind(m.materials())))


@document("games/shiny_zero.dae")
def shiny(folder):
    """Specular white with shininess 0 or 0.01: a highlight over everything in a naive reading."""
    m = shapes.bottle().join(shapes.mug().moved(0.3))
    fx, mats = painted(m.materials(), lambda c: phong(c, specular=(1, 1, 1), shininess=0.01), "phong")
    return collada(asset("Max 2012", "centimeter", 0.01, "Y_UP"), [("effects", fx), ("materials", mats), ("geometries", mesh("b", m, scaled(y_up, 100), normals="smooth"))], place_node("bn", "b", bind(m.materials())))


@document("games/glass_alone.dae", small=True)
def glass_alone(folder):
    """A bottle of glass with nothing around it: index of refraction 1.5, RGB_ZERO of 0.9."""
    m = shapes.bottle()
    fx, mats = painted(m.materials(), lambda c: phong(c, specular=(1, 1, 1), shininess=80, more='<transparent opaque="RGB_ZERO"><color>0.8 0.8 0.8 1</color></transparent>' + num("transparency", 1) + num("index_of_refraction", 1.5)))
    return collada(asset("FBX", "centimeter", 0.01, "Y_UP"), [("effects", fx), ("materials", mats), ("geometries", mesh("b", m, scaled(y_up, 100), normals="smooth"))], place_node("bn", "b", bind(m.materials())))


@document("games/chrome.dae")
def chrome(folder):
    """A chrome figure with black diffuse and reflectivity 1, nothing around it."""
    m = shapes.rover().named("chrome")
    fx = effect("chrome", phong((0, 0, 0), specular=(1, 1, 1), shininess=60, more=col("reflective", 1, 1, 1) + num("reflectivity", 1)), "blinn")
    return collada(asset("Max"), [("effects", fx), ("materials", material("chrome")), ("geometries", mesh("r", m))], place_node("rn", "r", bind(["chrome"])))


@document("games/headlight_inside.dae")
def light_inside(folder):
    """The only light is a point within a closed box: all that is seen lies in its shadow.""" 
    m = shapes.crate().join(shapes.person().moved(1.5))
    low, high = m.bounds()
    fx, mats = painted(m.materials(), lambert, "lambert")
    light = '<light id="l"><technique_common><point><color>1 1 1</color></point></technique_common></light>'
    return collada(asset("Anim8or"), [("lights", light), ("effects", fx), ("materials", mats), ("geometries", mesh("c", m))], place_node("cn", "c", bind(m.materials())) + '<node id="ln"><translate>0 0 0.3</translate><instance_light url="#l"/></node>')


@document("games/layered.dae")
def layered(folder):
    """Decals: a plane 1 mm above another, the picture's alpha cuts it; the scene is 100 m wide."""
    paint(folder, "decal.png", lambda x, y: (220, 200, 40, 255 if abs(x - 32) < 10 else 0), 4)
    ground, decal = shapes.box(-20, -20, -1, 20, 20, 0, "floor"), shapes.Mesh()
    decal.points = [(-18, -18, 0.001), (18, -18, 0.001), (18, 18, 0.001), (-18, 18, 0.001)]
    decal.faces = [((0, 1, 2, 3), "decal", ((0, 0), (1, 0), (1, 1), (0, 1)))]
    fx, mats = painted(["floor"], lambert, "lambert")
    fx += effect("decal", tex("diffuse", "d") + '<transparent opaque="A_ONE"><texture texture="d-sampler" texcoord="UVMap"/></transparent>', "lambert", sampler("d"))
    return collada(asset("Quest3D"), [("images", image("d", "decal.png")), ("effects", fx), ("materials", mats + material("decal")), ("geometries", mesh("g", ground) + mesh("dd", decal))], place_node("gn", "g", bind(["floor"])) + place_node("dn", "dd", bind(["decal"], channel="UVMap")))
