"""tests/conformance/differ_pairs.py: families of files no two of which may look alike."""
from dae import *  # noqa: F403
from dae import EYE, EYE_NODE, LAMBERT, OUTLINE, SUN, UV


def lit(kind, inside="", at="<translate>.4 1.6 1.6</translate><rotate>1 0 0 -50</rotate>"):
    light = (f'<light id="lamp"><technique_common><{kind}><color>1 1 1</color>{inside}</{kind}>'
             "</technique_common></light>\n")
    return plain(lights=light, light_nodes=f'<node id="lamp-node">{at}<instance_light url="#lamp"/></node>\n'
                 '<node id="base"><instance_light url="#base"/></node>\n').replace(
        "</library_lights>", '<light id="base"><technique_common><directional><color>.1 .1 .1</color>'
        "</directional></technique_common></light></library_lights>")


def light_terms():
    """Four kinds, three attenuations, the cone and its edge."""
    near = "<translate>0 .3 .9</translate>"
    cone = "<falloff_angle>{}</falloff_angle><falloff_exponent>{}</falloff_exponent>"
    return {"ambient": lit("ambient"), "directional": lit("directional"), "point": lit("point", at=near),
            "constant": lit("point", "<constant_attenuation>3</constant_attenuation>", near),
            "linear": lit("point", "<linear_attenuation>1.5</linear_attenuation>", near),
            "quadratic": lit("point", "<quadratic_attenuation>4</quadratic_attenuation>", near),
            "spot": lit("spot", cone.format(60, 0), near), "narrow_spot": lit("spot", cone.format(25, 0), near),
            "soft_spot": lit("spot", cone.format(60, 20), near),
            "red": lit("point", at=near).replace("<point><color>1 1 1", "<point><color>1 0 0"),
            "none": plain(lights="", light_nodes="")}


def wraps():
    """Texture coordinates from -0.75 to 1.75 and beyond."""
    texture = ('<texture texture="map-sampler" texcoord="UV"><extra><technique profile="MAYA"><repeatU>2.5'
               "</repeatU><repeatV>2.5</repeatV><offsetU>-.75</offsetU><offsetV>-.75</offsetV></technique>"
               "</extra></texture>")
    rows = {mode.lower(): textured(texture=texture, state=f"<wrap_s>{mode}</wrap_s><wrap_t>{mode}</wrap_t>"
                                   "<border_color>1 0 1 1</border_color>")
            for mode in ("WRAP", "MIRROR", "CLAMP", "BORDER")}
    rows["wrap_and_clamp"] = textured(texture=texture, state="<wrap_s>WRAP</wrap_s><wrap_t>CLAMP</wrap_t>")
    return rows | {"map.png": png(picture())}


def filters():
    return {"linear": textured(), "nearest": textured(
        state="<minfilter>NEAREST</minfilter><magfilter>NEAREST</magfilter>"),
        "map.png": png([[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 255)]])}


def minifications():
    """Several texels a pixel: one, four, of one level, of two; of nearer and of no coarser levels."""
    many = ('<texture texture="map-sampler" texcoord="UV"><extra><technique profile="MAYA"><repeatU>1.5</repeatU>'
            "<repeatV>1.5</repeatV></technique></extra></texture>")
    smooth = "<minfilter>LINEAR_MIPMAP_LINEAR</minfilter>"
    rows = {name.lower(): f"<minfilter>{name}</minfilter>" for name in (
        "NEAREST", "LINEAR", "NEAREST_MIPMAP_NEAREST", "LINEAR_MIPMAP_NEAREST", "NEAREST_MIPMAP_LINEAR",
        "LINEAR_MIPMAP_LINEAR")}
    rows |= {"biased": smooth + "<mipmap_bias>-2</mipmap_bias>", "limited": smooth + "<mipmap_maxlevel>1</mipmap_maxlevel>"}
    bits, blocks = 12345, []  # 16 x 16 blocks of 4 x 4 texels
    for _ in range(256):
        bits = (bits * 1103515245 + 12345) % 2**31
        blocks.append(tuple(255 * (bits >> k & 1) for k in (20, 24, 28)))
    texels = [[blocks[y // 4 * 16 + x // 4] for x in range(64)] for y in range(64)]
    return {name: textured(texture=many, state=state) for name, state in rows.items()} | {"map.png": png(texels)}


def texture_placements():
    def placed(text):
        return textured(texture='<texture texture="map-sampler" texcoord="UV"><extra><technique profile="MAYA">'
                        f"{text}</technique></extra></texture>")
    return {"plain": textured(), "repeated": placed("<repeatU>2</repeatU><repeatV>3</repeatV>"),
            "moved": placed("<offsetU>.4</offsetU>"), "turned": placed("<rotateUV>90</rotateUV>"),
            "turned_back": placed("<rotateUV>-90</rotateUV>"), "map.png": png(picture())}


def opaque_modes():
    """One transparent colour, read by each mode."""
    def seen(inside, amount=.5):
        return plain(effects=effect('<lambert><diffuse><color>.8 .5 .2 1</color></diffuse>' + inside
                                    + f"<transparency><float>{amount}</float></transparency></lambert>"))
    mode = '<transparent opaque="{}"><color>.9 .1 .5 .8</color></transparent>'
    rows = {m.lower(): seen(mode.format(m)) for m in ("A_ONE", "A_ZERO", "RGB_ONE", "RGB_ZERO")}
    return rows | {"more": seen(mode.format("A_ONE"), 1.1), "opaque": plain()}


def shading_models():
    inside = ('<diffuse><color>.4 .5 .2 1</color></diffuse><specular><color>1 1 1 1</color></specular><shininess>'
              '<float>6</float></shininess>')
    glow = '<emission><color>.4 .5 .2 1</color></emission>'
    face_on = dict(light_nodes='<node id="sun-node"><translate>0 0 3</translate><rotate>0 1 0 20</rotate>'
                   '<instance_light url="#sun"/></node>')
    models = {"constant": f"<constant>{glow}</constant>",
              "lambert": "<lambert><diffuse><color>.4 .5 .2 1</color></diffuse></lambert>",
              "phong": f"<phong>{inside}</phong>", "blinn": f"<blinn>{inside}</blinn>",
              "dull_phong": f"<phong>{inside.replace('>6<', '>2<')}</phong>",
              "emission": f"<lambert>{glow}<diffuse><color>.4 .5 .2 1</color></diffuse></lambert>"}
    return {name: plain(effects=effect(text), **face_on) for name, text in models.items()}


def interpolations():
    """Three keys at 0, 1 and 2 s, looked at between them."""
    turn = '<rotate sid="r">0 0 1 0</rotate>'
    keys, values = [0, 1, 2], [(0,), (20,), (120,)]

    def drawn(kind, **words):
        return document(node(transforms=turn),
                        animations=animated("n/r.ANGLE", keys, values, interpolation=kind, **words))
    bent = ([(-.5, 0), (.6, 60), (1.6, 160)], [(.3, -70), (1.3, 90), (2.3, 100)])
    return {"linear": drawn("LINEAR"), "step": drawn("STEP"), "bezier": drawn("BEZIER", tangents=bent),
            "hermite": drawn("HERMITE", tangents=([(200,)] * 3, [(-90,)] * 3)),
            "cardinal": drawn("CARDINAL"), "bspline": drawn("BSPLINE")}


def behaviours():
    """Keys end at 1 s; 1.75 s is looked at."""
    turn = '<rotate sid="r">0 0 1 0</rotate>'
    keys, values = [0, .5, 1], [(10,), (25,), (60,)]

    def drawn(kind):
        text = f' pre_behavior="{kind}" post_behavior="{kind}"' if kind else ""
        return document(node(transforms=turn), version="1.5.0",
                        animations=animated("n/r.ANGLE", keys, values, behaviour=text))
    return {"constant": drawn("CONSTANT"), "gradient": drawn("GRADIENT"), "cycle": drawn("CYCLE"),
            "oscillate": drawn("OSCILLATE"), "cycle_relative": drawn("CYCLE_RELATIVE")}


def clips():
    """--clip plays a range: each file is one range of a single instant."""
    turn = '<rotate sid="r">0 0 1 0</rotate>'
    both = animated("n/r.ANGLE", [0, 1, 2], [(0,), (30,), (90,)])

    def named(start):
        return document(node(transforms=turn), animations=both,
                        clips=f'<animation_clip id="c" start="{start}" end="{start}"><instance_animation url="#a"/>'
                              "</animation_clip>")
    return {"at_0": named(0), "at_1": named(1), "at_2": named(2)}


def transform_steps():
    """Each kind of step moves, and their order counts."""
    steps = {"none": "", "translate": "<translate>.2 .1 0</translate>", "rotate": "<rotate>0 0 1 20</rotate>",
             "scale": "<scale>1 .6 1</scale>", "skew": "<skew>25 1 0 0 0 1 0</skew>",
             "skew_back": "<skew>-25 1 0 0 0 1 0</skew>", "skew_other": "<skew>25 0 1 0 1 0 0</skew>",
             "lookat": "<lookat>0 0 0 1 0 1 0 1 0</lookat>",
             "matrix": "<matrix>1 .3 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>",
             "turn_then_scale": "<rotate>0 0 1 20</rotate><scale>1 .6 1</scale>",
             "scale_then_turn": "<scale>1 .6 1</scale><rotate>0 0 1 20</rotate>"}
    return {name: document(node(transforms=text)) for name, text in steps.items()}


def bumps():
    """Heights, normals, their amounts."""
    def bump(inside="", attribute=""):
        return textured(texture="", path="map.png").replace(
            "<diffuse></diffuse>", "<diffuse><color>.8 .8 .8 1</color></diffuse>").replace(
            "</technique></profile_COMMON>", f'<extra><technique profile="FCOLLADA"><bump{attribute}><texture '
            f'texture="map-sampler" texcoord="UV">{inside}</texture></bump></technique></extra></technique>'
            "</profile_COMMON>")
    more = '<extra><technique profile="MAX3D"><amount>4</amount></technique></extra>'
    flat_one = textured(texture="").replace("<diffuse></diffuse>", "<diffuse><color>.8 .8 .8 1</color></diffuse>")
    waves = [[(v := 255 * (x // 4 % 2), v, v) for x in range(16)] for _ in range(16)]
    return {"flat": flat_one, "bump": bump(), "more": bump(more), "normals": bump(attribute=' bumptype="NORMALMAP"'),
            "map.png": png(waves)}


def sides():
    """Seen from behind, a one-sided square is not there."""
    points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    mesh = (source("house-p", points, "XYZ")
            + '<vertices id="house-v"><input semantic="POSITION" source="#house-p"/></vertices>'
              '<polylist count="1" material="m"><input semantic="VERTEX" source="#house-v" offset="0"/><vcount>4'
              "</vcount><p>3 2 1 0</p></polylist>")

    def seen(extra):
        return plain(geometries=f'<geometry id="house"><mesh>{mesh}</mesh>{extra}</geometry>')
    flag = '<extra><technique profile="MAYA"><double_sided>{}</double_sided></technique></extra>'
    return {"two": seen(flag.format(1)), "one": seen(flag.format(0))}


def texture_sets():
    """bind_vertex_input chooses among two sets."""
    second = source("house-t2", [(v, 1 - u) for u, v in UVS], "ST")
    mesh = geometry().replace("<vertices", second + "<vertices").replace(
        'set="0"/>', 'set="0"/><input semantic="TEXCOORD" source="#house-t2" offset="2" set="3"/>')

    def bound(number):
        return textured(inside=UV.replace('input_set="0"', f'input_set="{number}"'), geometries=mesh)
    return {"first": bound(0), "second": bound(3), "map.png": png(picture())}


def camera_views():
    def seen(optics, eye=EYE_NODE):
        return plain(cameras=camera(optics), eye=eye)
    clip = "<znear>.1</znear><zfar>100</zfar>"
    return {"wide": seen(f"<perspective><yfov>60</yfov>{clip}</perspective>"),
            "narrow": seen(f"<perspective><yfov>40</yfov>{clip}</perspective>"),
            "orthographic": seen(f"<orthographic><ymag>1.2</ymag>{clip}</orthographic>"),
            "cut_near": seen("<perspective><yfov>40</yfov><znear>3.3</znear><zfar>100</zfar></perspective>"),
            "cut_far": seen("<perspective><yfov>40</yfov><znear>.1</znear><zfar>3.3</zfar></perspective>"),
            "none": plain(cameras="", eye=""), "none_z_up": plain(cameras="", eye="", up="Z_UP")}


def chosen_cameras():
    """The first of the document, or what evaluate_scene names."""
    two = EYE_NODE + '<node id="side"><translate>0 0 6</translate><instance_camera url="#eye"/></node>\n'
    render = '<evaluate_scene><render camera_node="#side"/></evaluate_scene>\n'
    return {"first": plain(eye=two), "evaluated": plain(eye=two, evaluate=render)}


def holes():
    """A hole is open; what is left out of the outline is, too."""
    points = [(x * 1.4, y * 1.4, 0) for x, y in OUTLINE] + [(-.3, -.2, 0), (.3, -.2, 0), (0, .4, 0), (0, -.3, 0)]
    mesh = (source("house-p", points, "XYZ")
            + '<vertices id="house-v"><input semantic="POSITION" source="#house-p"/></vertices>')
    one = '<input semantic="VERTEX" source="#house-v" offset="0"/>'
    polygon = {"whole": "<p>0 1 2 3 4</p>", "hole": "<ph><p>0 1 2 3 4</p><h>5 7 6</h></ph>",
               "concave": "<p>0 8 1 2 3 4</p>", "more_concave": "<p>0 7 1 2 3 4</p>"}
    return {name: plain(geometries=f'<geometry id="house"><mesh>{mesh}<polygons count="1" material="m">{one}{text}'
                        "</polygons></mesh></geometry>") for name, text in polygon.items()}


def skins_and_morphs():
    """Joints and weights at work."""
    tall = geometry(id="target", points=[(x, y * 1.6, z) for x, y, z in POINTS])

    def bent(turn):
        return document(joints(turn) + node(shown("#skin", kind="controller", skeleton="<skeleton>#bone-low</skeleton>")),
                        controllers=skin(["low", "high"]))

    def grown(weight, method="NORMALIZED"):
        return document(node(shown("#morph", kind="controller")), geometries=geometry() + tall,
                        controllers=morph(["target"], [weight], method=method))
    return {"straight": bent(0), "bent": bent(30), "bent_more": bent(60), "half_grown": grown(.5), "grown": grown(1),
            "added": grown(.5, "RELATIVE")}


def units_of_others():
    """The unit and axis of another document count where it is used."""
    holds = dict(scene=False, lights="", cameras="", materials="", effects="")
    at = lambda url: document(node(shown(url), "<scale>20 20 20</scale>" if "cm" in url else ""), geometries=" ")  # noqa: E731
    return {"metre": at("parts/m.dae#house"), "centimetre": at("parts/cm.dae#house"), "z_up": at("parts/z.dae#house"),
            "parts/m": document("", **holds), "parts/cm": document("", unit='meter="0.01"', **holds),
            "parts/z": document("", up="Z_UP", **holds)}


FAMILIES = {f.__name__: f for f in (
    light_terms, wraps, filters, minifications, texture_placements, opaque_modes, shading_models, interpolations, behaviours, clips,
    transform_steps, bumps, sides, texture_sets, camera_views, chosen_cameras, holes, skins_and_morphs,
    units_of_others)}
OPTIONS = {"interpolations": ["--time", "1.4"], "behaviours": ["--time", "1.75"], "clips": ["--clip", "c"]}
