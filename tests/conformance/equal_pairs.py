"""tests/conformance/equal_pairs.py: families of files that are different ways to say one thing."""
import math

from dae import *  # noqa: F403
from dae import EYE, EYE_NODE, IDENTITY, INPUTS, LAMBERT, OUTLINE, POINTS, SUN, UV


def primitives():
    faces = corners()
    count = len(faces)
    everything = " ".join(indices(f) for f in faces)
    vcount = numbers(len(f) for f in faces)
    strip = lambda f: [f[0], f[1], f[-1], f[2]] + ([f[3]] if len(f) > 4 else [])  # noqa: E731
    # A strip turns every second triangle; 0 1 4 | 1 2 4 is 0 1 4 2, then 3 closes the pentagon.
    rows = {
        "triangles": triangles(),
        "polylist": f'<polylist count="{count}" material="m">{INPUTS.format("house")}<vcount>{vcount}'
                    f'</vcount><p>{everything}</p></polylist>',
        "polygons": f'<polygons count="{count}" material="m">{INPUTS.format("house")}'
                    + "".join(f"<p>{indices(f)}</p>" for f in faces) + "</polygons>",
        "trifans": f'<trifans count="{count}" material="m">{INPUTS.format("house")}'
                   + "".join(f"<p>{indices(f)}</p>" for f in faces) + "</trifans>",
        "tristrips": f'<tristrips count="{count}" material="m">{INPUTS.format("house")}'
                     + "".join(f"<p>{indices(strip(f))}</p>" for f in faces) + "</tristrips>",
        "several_elements": "".join(
            f'<triangles count="{len(f) - 2}" material="m">{INPUTS.format("house")}<p>'
            f'{" ".join(indices(t) for t in triangulated([f]))}</p></triangles>' for f in faces),
        "with_lines": triangles() + '<lines count="1"><input semantic="VERTEX" source="#house-v" '
                                    'offset="0"/><p>0 6</p></lines>',
    }
    return {name: plain(geometries=geometry(text)) for name, text in rows.items()}


def inputs():
    """The same triangles with their numbers stored in other ways."""
    plain_rows = triangulated()
    one_each = [c for t in plain_rows for c in t]
    points = [POINTS[p] for p, _, _ in one_each]
    count = len(points)
    shared = (source("house-p", points, "XYZ") + source("house-n", [NORMALS[n] for _, n, _ in one_each], "XYZ"))
    order = numbers(range(count))
    in_vertices = (shared + '<vertices id="house-v"><input semantic="POSITION" source="#house-p"/><input '
                   'semantic="NORMAL" source="#house-n"/></vertices>'
                   f'<triangles count="{count // 3}" material="m"><input semantic="VERTEX" '
                   f'source="#house-v" offset="0"/><p>{order}</p></triangles>')
    one_offset = (shared + '<vertices id="house-v"><input semantic="POSITION" source="#house-p"/></vertices>'
                  f'<triangles count="{count // 3}" material="m"><input semantic="VERTEX" '
                  'source="#house-v" offset="0"/><input semantic="NORMAL" source="#house-n" offset="0"/>'
                  f'<p>{order}</p></triangles>')
    # Interleaved: x y z nx ny nz, by offset and unnamed params.
    values = numbers(flat(p + NORMALS[n] for p, (_, n, _) in zip(points, one_each)))
    array = f'<float_array id="all" count="{6 * count}">{values}</float_array>'

    def accessor(offset, names):
        params = "".join(f'<param {n} type="float"/>' for n in names)
        return (f'<technique_common><accessor source="#all" count="{count}" offset="{offset}" stride="6">'
                f'{params}</accessor></technique_common></source>')
    xyz = ['name="X"', 'name="Y"', 'name="Z"']
    interleaved = (f'<source id="house-p">{array}{accessor(0, xyz)}<source id="house-n">'
                   f'{accessor(0, [""] * 3 + xyz)}'
                   + in_vertices[in_vertices.index("<vertices"):])
    wrap = lambda mesh: f'<geometry id="house"><mesh>{mesh}</mesh></geometry>'  # noqa: E731
    return {"separate": plain(), "in_vertices": plain(geometries=wrap(in_vertices)),
            "one_offset": plain(geometries=wrap(one_offset)),
            "interleaved": plain(geometries=wrap(interleaved))}


def solids():
    """A convex mesh is drawn as a mesh; the hull of a convex geometry is that geometry."""
    convex = geometry().replace("<mesh>", "<convex_mesh>").replace("</mesh>", "</convex_mesh>")
    hull = '<geometry id="hull"><convex_mesh convex_hull_of="#house"/></geometry>'
    return {"mesh": plain(), "convex_mesh": plain(geometries=convex),
            "hull": document(node(shown("#hull")), geometries=convex + hull)}


def polygons_with_holes():
    """A square frame, seen from the front."""
    outer, inner = [(-1, -1), (1, -1), (1, 1), (-1, 1)], [(-.5, -.5), (.5, -.5), (.5, .5), (-.5, .5)]
    points = [(x, y, 0) for x, y in outer + inner]
    start = (source("house-p", points, "XYZ")
             + '<vertices id="house-v"><input semantic="POSITION" source="#house-p"/></vertices>')
    one = '<input semantic="VERTEX" source="#house-v" offset="0"/>'
    quads = " ".join(numbers((k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4)) for k in range(4))
    rows = {
        "hole": f'<polygons count="1" material="m">{one}<ph><p>0 1 2 3</p><h>7 6 5 4</h></ph></polygons>',
        "hole_same_winding": f'<polygons count="1" material="m">{one}<ph><p>0 1 2 3</p><h>4 5 6 7</h></ph>'
                             '</polygons>',
        "quads": f'<polylist count="4" material="m">{one}<vcount>4 4 4 4</vcount><p>{quads}</p></polylist>',
        "concave": f'<polylist count="1" material="m">{one}<vcount>10</vcount><p>0 1 2 3 0 4 7 6 5 4</p>'
                   '</polylist>',
    }
    flat_eye = EYE_NODE.replace(EYE, "<translate>0 0 4</translate>")
    return {name: plain(eye=flat_eye, geometries=f'<geometry id="house"><mesh>{start}{text}</mesh></geometry>')
            for name, text in rows.items()}


def product(a, b):
    return tuple(sum(a[r * 4 + k] * b[k * 4 + c] for k in range(4)) for r in range(4) for c in range(4))


def transforms():
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    move = (1, 0, 0, .2, 0, 1, 0, -.1, 0, 0, 1, .1, 0, 0, 0, 1)
    turn = (c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    scale = (.8, 0, 0, 0, 0, 1.1, 0, 0, 0, 0, .9, 0, 0, 0, 0, 1)
    whole = product(product(move, turn), scale)
    stack = "<translate>.2 -.1 .1</translate><rotate>0 0 1 30</rotate><scale>.8 1.1 .9</scale>"
    nested = (f'<node id="a"><translate>.2 -.1 .1</translate><node id="b"><rotate>0 0 2 390</rotate>'
              f'<node id="c"><scale>.8 1.1 .9</scale>{shown()}</node></node></node>')
    return {"stack": document(node(transforms=stack)),
            "matrix": document(node(transforms=f"<matrix>{numbers(whole)}</matrix>")),
            "matrices": document(node(transforms="".join(f"<matrix>{numbers(m)}</matrix>"
                                                         for m in (move, turn, scale)))),
            "nested": document(nested)}


def cameras_by_lookat():
    """The eye's lookat, its matrix, and the same looked up through a moved parent."""
    eye, at, up = (1.3, .9, 3), (0, .1, 0), (0, 1, 0)
    unit = lambda v: tuple(x / math.sqrt(sum(y * y for y in v)) for x in v)  # noqa: E731
    cross = lambda a, b: (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])  # noqa: E731
    back = unit([e - a for e, a in zip(eye, at)])
    right = unit(cross(up, back))
    top = cross(back, right)
    m = [v for k in range(3) for v in (right[k], top[k], back[k], eye[k])] + [0, 0, 0, 1]
    parent = (f'<node id="rig"><translate>0 0 1</translate><node id="eye-node"><lookat>1.3 .9 2  0 .1 -1  '
              '0 1 0</lookat><instance_camera url="#eye"/></node></node>')
    return {"lookat": plain(), "matrix": plain(eye=EYE_NODE.replace(EYE, f"<matrix>{numbers(m)}</matrix>")),
            "in_a_parent": plain(eye=parent)}


def skews():
    """p + tan(30) (p . x) y: y grows by x tan 30, as the suite's pictures have it."""
    t = math.tan(math.radians(30))
    matrix = (1, 0, 0, 0, t, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    return {"skew": document(node(transforms="<skew>30 0 1 0 1 0 0</skew>")),
            "matrix": document(node(transforms=f"<matrix>{numbers(matrix)}</matrix>"))}


def references():
    """Inline, in a library, in other files and folders, percent-encoded, in other units and axes."""
    holds = dict(scene=False, lights="", cameras="", materials="", effects="")
    part = document("", **holds)
    far = 1 / .0254
    inches = document("", geometries=geometry(points=[tuple(v * far for v in p) for p in POINTS]),
                      unit='name="inch" meter="0.0254"', **holds)
    # Z up: their (x, y, z) is our (x, z, -y); normals turn along.
    text = geometry(points=[(x, -z, y) for x, y, z in POINTS])
    own = source("house-n", NORMALS, "XYZ")
    turned = source("house-n", [(x, -z, y) for x, y, z in NORMALS], "XYZ")
    z_up = document("", geometries=text.replace(own, turned), up="Z_UP", **holds)
    nodes = document("", library_nodes=f'<node id="whole">{shown()}</node>', scene=False, lights="",
                     cameras="")
    mats = document("", geometries=" ", scene=False, lights="", cameras="")
    lamps = document("", geometries=" ", materials="", effects="", scene=False)
    at = lambda url: document(node(shown(url)), geometries=" ")  # noqa: E731
    instance = '<node id="n"><instance_node url="{}"/></node>'
    return {
        "inline": plain(),
        "library_node": document(instance.format("#whole"), library_nodes=f'<node id="whole">{shown()}</node>'),
        "external_geometry": at("parts/house.dae#house"),
        "external_encoded": at("parts/a%20house%231.dae#house"),
        "external_inches": at("parts/inches.dae#house"),
        "external_z_up": at("parts/z_up.dae#house"),
        "external_node": document(instance.format("parts/nodes.dae#whole"), geometries=" ", effects=" ",
                                  materials=" "),
        "external_material": document(node(shown(inside=bind().replace("#mat", "parts/materials.dae#mat"))),
                                      effects=" ", materials=" "),
        "external_lights": document(node(), lights=" ", cameras=" ").replace(
            'url="#sun"', 'url="parts/lamps.dae#sun"').replace('url="#air"', 'url="parts/lamps.dae#air"').replace(
            'url="#eye"', 'url="parts/lamps.dae#eye"'),
        "external_scene": document("", scene=False, lights="", cameras="", geometries=" ", effects=" ",
                                   materials=" ").replace(
            "</COLLADA>", '<scene><instance_visual_scene url="parts/scene.dae#scene"/></scene></COLLADA>'),
        "parts/house": part, "parts/a house#1": part, "parts/inches": inches, "parts/z_up": z_up,
        "parts/nodes": nodes, "parts/materials": mats, "parts/lamps": lamps, "parts/scene": plain(),
    }


def bases():
    """xml:base moves where relative URIs start; an absolute one of another machine does not."""
    def based(base, path, house):
        return textured(path=path, geometries=" ").replace("#house", f"{house}#house").replace(
            '">\n<asset>', f'" xml:base="{base}">\n<asset>', 1)
    part = document("", scene=False, lights="", cameras="", materials="", effects="")
    return {"none": textured(path="parts/map.png"), "folder": based("parts/", "map.png", "house.dae"),
            "file": based("./parts/a%20document.dae", "map.png", "house.dae"),
            "above": based("parts/deep/", "../map.png", "../house.dae"),
            "of_the_network": based("http://example.org/x/", "parts/map.png", "parts/house.dae"),
            "not_there": based("nowhere/", "parts/map.png", "parts/house.dae"),
            "parts/house": part, "parts/map.png": png(picture())}


def absolute_references():
    """What was absolute on the author's machine lies beside the document."""
    def at(url):
        return document(node(shown(url)), geometries=" ")
    return {"inline": plain(), "drive": at("file:///C:/work/parts.dae#house"),
            "folder": at("old/parts.dae#house"),
            "parts": plain()}


def samplers():
    """A surface within and without its sampler's scope, and those that a material sets."""
    whole = textured()
    start = whole.index('<newparam sid="map-sampler">')
    sampler = whole[start:whole.index("</newparam>", start) + len("</newparam>")]
    other = whole.replace("</library_images>", '<image id="other"><init_from>other.png</init_from></image>'
                          "</library_images>")
    wrong = other.replace("<init_from>map</init_from>", "<init_from>other</init_from>")

    def given(param):
        use = '<instance_effect url="#fx">'
        return wrong.replace(use, use + param)
    surface = '<surface type="2D"><init_from>map</init_from></surface>'
    new = f'<newparam sid="new">{surface}</newparam><newparam sid="new-sampler"><sampler2D><source>new</source>' \
          '</sampler2D></newparam>'
    return {"plain": whole,
            "sampler_outside": whole.replace(sampler, "").replace("<profile_COMMON>", sampler + "<profile_COMMON>"),
            "set_surface": given(f'<setparam ref="map-surface">{surface}</setparam>'),
            "set_sampler": given(f'<setparam ref="map-sampler"><sampler2D><source>map</source></sampler2D></setparam>'),
            "set_both": given(f'<setparam ref="map-surface">{surface}</setparam><setparam ref="map-sampler"><sampler2D>'
                              "<source>map-surface</source></sampler2D></setparam>"),
            "planar": whole.replace("<init_from>map</init_from>", '<init_planar><all ref="map"/></init_planar>', 1),
            "unused_params": whole.replace("<technique sid", new + "<technique sid"),
            "map.png": png(picture()), "other.png": png([[(9, 9, 9)]])}


def versions():
    """1.4.0, 1.4.1 and 1.5.0 spell images, samplers and joints in their own ways."""
    return {"v141": textured(), "v150": textured(version="1.5.0"),
            "v140": textured().replace('version="1.4.1"', 'version="1.4.0"'), "map.png": png(picture())}


def units():
    """World space is the file's own: without other documents its tags move nothing."""
    return {"metre": plain(), "inch": plain(unit='name="inch" meter="0.0254"'), "z_up": plain(up="Z_UP"),
            "x_up": plain(up="X_UP")}


def assets():
    """An <asset> inside: at a geometry, its library, a node; in inches, and with z up."""
    def asset(inside):
        return ("<asset><created>2026-11-21T00:00:00Z</created><modified>2026-11-21T00:00:00Z</modified>"
                f"{inside}</asset>")
    inch, z_up = asset('<unit name="inch" meter="0.0254"/>'), asset("<up_axis>Z_UP</up_axis>")
    far = geometry(points=[tuple(v / .0254 for v in p) for p in POINTS])
    own = source("house-n", NORMALS, "XYZ")
    turned = source("house-n", [(x, -z, y) for x, y, z in NORMALS], "XYZ")
    up = geometry(points=[(x, -z, y) for x, y, z in POINTS]).replace(own, turned)
    moved = f'<node id="n"><translate>.254 0 0</translate>{shown()}</node>'
    still = f'<node id="n"><translate>.254 0 0</translate><node id="m">{inch}{shown()}</node></node>'
    y_up = asset("<up_axis>Y_UP</up_axis>")
    # What a node instances has its own unit and axes, which are the document's here.
    turned_node = (f'<node id="n">{z_up}<translate>.254 0 0</translate><rotate>0 0 1 90</rotate>'
                   f'<node id="m">{y_up}<rotate>0 1 0 -90</rotate>{shown()}</node></node>')
    instanced = f'<node id="n">{inch}<translate>10 0 0</translate><instance_node url="#whole"/></node>'
    eye = EYE_NODE.replace(EYE, inch + "<lookat>{}</lookat>".format(
        "  ".join(" ".join(repr(v / .0254) for v in p) for p in ((1.3, .9, 3), (0, .1, 0))) + "  0 1 0"))
    suns = SUN_NODES.replace("<rotate>0 1 0 30</rotate>", z_up + "<rotate>0 0 1 30</rotate>")
    return {"none": document(moved),
            "geometry": document(moved, geometries=far.replace("<mesh>", inch + "<mesh>")),
            "library": document(moved, geometries=inch + far),
            "geometry_z_up": document(moved, geometries=up.replace("<mesh>", z_up + "<mesh>")),
            "node": document(f'<node id="n">{inch}<translate>10 0 0</translate>{shown()}</node>'),
            "inner_node": document(still),
            "child_of_node": document(f'<node id="n">{inch}<translate>4 0 0</translate><node id="m">'
                                      f'<translate>6 0 0</translate>{shown()}</node></node>'),
            "node_z_up": document(turned_node),
            "node_of_node": document(instanced, library_nodes=f'<node id="whole">{shown()}</node>'),
            "eye": document(moved, eye=eye), "light_z_up": document(moved, light_nodes=suns),
            "library_node": document('<node id="n"><instance_node url="#whole"/></node>', library_nodes=inch
                                     + f'<node id="whole"><translate>10 0 0</translate>{shown()}</node>'),
            "visual_scene": document(f'<node id="n"><translate>.254 0 0</translate>{shown()}</node>').replace(
                '<visual_scene id="scene">', f'<visual_scene id="scene">{asset("<up_axis>Y_UP</up_axis>")}')}


def normals():
    """Every face of the house is flat: without normals it looks the same."""
    without = triangles().replace(
        '<input semantic="NORMAL" source="#house-n" offset="1"/>', "")
    return {"given": plain(), "none": plain(geometries=geometry(without))}


def smooth_sides():
    """Faces that turn by 30 degrees are smooth where the mesh has no normals; the ends keep their creases."""
    return {"none": plain(geometries=prism(12)), "given": plain(geometries=prism(12, smooth=True))}


def flat_sides():
    """Those that turn by 45 degrees are flat."""
    return {"none": plain(geometries=prism(8)), "given": plain(geometries=prism(8, smooth=False))}


def smoothed_sides():
    """--smooth 50"""
    return {"none": plain(geometries=prism(8)), "given": plain(geometries=prism(8, smooth=True))}


def flattened_sides():
    """--smooth 0"""
    return {"none": plain(geometries=prism(12)), "given": plain(geometries=prism(12, smooth=False))}


def only_materials():
    """Primitives without a symbol, or with one that is bound nowhere, and one material."""
    return {"named": plain(), "without": plain(geometries=geometry(triangles().replace(' material="m"', ""))),
            "misspelt": document(node(shown(inside=bind(symbol="M"))))}


def archives():
    """main.dae alone and packed (the test's maker zips what FILES names)."""
    return {"plain": textured(path="images/map.png"), "images/map.png": png(picture()),
            "packed.zae": {"manifest.xml": "<dae_root>./scenes/a%20scene.dae</dae_root>",
                           "scenes/a scene.dae": textured(path="../images/map.png"),
                           "images/map.png": png(picture())},
            "packed.kmz": {"doc.kml": '<kml xmlns="http://www.opengis.net/kml/2.2"><Placemark><Model><Link>'
                                      "<href>models/scene.dae</href></Link></Model></Placemark></kml>",
                           "models/scene.dae": textured(), "models/map.png": png(picture())}}


def fields_of_view():
    """A square picture of 40 degrees, said in every way."""
    def seen(inside):
        return plain(cameras=camera(f"<perspective>{inside}<znear>.1</znear><zfar>100</zfar></perspective>"))
    return {"yfov": seen("<yfov>40</yfov>"), "xfov": seen("<xfov>40</xfov>"),
            "both": seen("<xfov>40</xfov><yfov>40</yfov>"),
            "yfov_aspect": seen("<yfov>40</yfov><aspect_ratio>1</aspect_ratio>"),
            "xfov_aspect": seen("<xfov>40</xfov><aspect_ratio>1</aspect_ratio>")}


def magnifications():
    def seen(inside):
        return plain(cameras=camera(f"<orthographic>{inside}<znear>.1</znear><zfar>100</zfar></orthographic>"))
    return {"ymag": seen("<ymag>1.2</ymag>"), "xmag": seen("<xmag>1.2</xmag>"),
            "both": seen("<xmag>1.2</xmag><ymag>1.2</ymag>"),
            "xmag_aspect": seen("<xmag>1.2</xmag><aspect_ratio>1</aspect_ratio>")}


def instances():
    """Two houses: two nodes, two instances of one, and a tree of instances."""
    small = "<scale>.5 .5 .5</scale>"
    left, right = f"<translate>-.5 0 0</translate>{small}", f"<translate>.5 0 0</translate>{small}"
    use = '<instance_node url="#one"/>'
    one = f'<node id="one">{shown()}</node>'
    two = f'<node id="two">{node(use, left, "l")}{node(use, right, "r")}</node>'
    return {"nodes": document(node(transforms=left) + node(transforms=right, id="n2")),
            "instances": document(node(use, left) + node(use, right, "n2"), library_nodes=one),
            "tree": document('<node id="n"><instance_node url="#two"/></node>', library_nodes=two + one)}


def skins():
    """The upper half turned by 25 degrees: joints found in every way, and the mesh baked so."""
    roots = "<skeleton>#bone-low</skeleton>"

    def skinned(words, tree, *, skeleton=roots, **kinds):
        use = shown("#skin", kind="controller", skeleton=skeleton)
        return document(tree + node(use), controllers=skin(words, **kinds))
    tree = joints()
    both = ["low", "high"]
    by_id = ["bone-low", "bone-high"]
    turned = []
    c, s = math.cos(math.radians(25)), math.sin(math.radians(25))
    for x, y, z in POINTS:
        turned.append((x, y, z) if y < 0 else (c * x - s * y, s * x + c * y, z))
    bare = geometry().replace('<input semantic="NORMAL" source="#house-n" offset="1"/>', "")
    baked = geometry(points=turned).replace('<input semantic="NORMAL" source="#house-n" offset="1"/>', "")
    documents = {
        "sids": skinned(both, tree),
        "no_skeleton": skinned(both, tree, skeleton=""),
        "ids": skinned(by_id, tree, array="IDREF_array", kind="IDREF"),
        "names": skinned(both, tree.replace("sid=\"low\"", "name=\"low\"").replace("sid=\"high\"", "name=\"high\"")),
        "sidrefs": skinned(["bone-low", "bone-low/high"], tree, array="SIDREF_array", kind="SIDREF").replace(
            SPACES["1.4.1"], SPACES["1.5.0"]).replace('version="1.4.1"', 'version="1.5.0"'),
        "baked": document(node(), geometries=baked),
    }
    lit = effect("<constant><emission><color>.8 .5 .2 1</color></emission></constant>")  # normals do not tell
    return {name: text.replace(geometry(), bare).replace(effect(), lit) for name, text in documents.items()}


def skin_spaces():
    """A skin below a turned armature: its bind shape given, forgotten, or not needed."""
    c, s = math.cos(math.radians(20)), math.sin(math.radians(20))
    place = (c, -s, 0, .2, s, c, 0, .1, 0, 0, 1, 0, 0, 0, 0, 1)
    back = (c, s, 0, -.2 * c - .1 * s, -s, c, 0, .2 * s - .1 * c, 0, 0, 1, 0, 0, 0, 0, 1)
    bend = animated("bone-high/turn.ANGLE", [0, 1], [(0,), (30,)])
    use = node(shown("#skin", kind="controller", skeleton="<skeleton>#bone-low</skeleton>"))

    def skinned(inverse, shape=None, outside=False):
        tree = f'<node id="arm"><matrix>{numbers(place)}</matrix>{joints(0)}{"" if outside else use}</node>'
        text = "" if shape is None else f"<bind_shape_matrix>{numbers(shape)}</bind_shape_matrix>"
        lit = effect("<constant><emission><color>.8 .5 .2 1</color></emission></constant>")
        return document(tree + (use if outside else ""), animations=bend, effects=lit,
                        controllers=skin(["low", "high"], inverses=[inverse] * 2, shape=text))
    return {"given": skinned(back, place), "given_at_the_root": skinned(back, place, True),
            "forgotten": skinned(back), "identity": skinned(back, IDENTITY), "in_the_joints": skinned(IDENTITY)}


def morphs():
    """A tall house at weight 0.5, as the difference, as the target, and baked."""
    tall = [(x, y * 1.6, z) for x, y, z in POINTS]
    step = [(0, y * .6, 0) for x, y, z in POINTS]
    half = [(x, y * 1.3, z) for x, y, z in POINTS]
    lit = effect("<constant><emission><color>.8 .5 .2 1</color></emission></constant>")  # normals do not tell
    use = node(shown("#morph", kind="controller"))

    def morphed(points, weights, method, names=("target",)):
        extra = "".join(geometry(id=n, points=points) for n in names)
        return document(use, geometries=geometry() + extra, effects=lit,
                        controllers=morph(list(names), weights, method=method))
    on_skin = document(joints(0) + node(shown("#skin", kind="controller",
                                              skeleton="<skeleton>#bone-low</skeleton>")),
                       geometries=geometry() + geometry(id="target", points=tall), effects=lit,
                       controllers=morph(["target"], [.5]) + skin(["low", "high"], mesh="morph"))
    moved = document(use, geometries=geometry() + geometry(id="target", points=tall), effects=lit,
                     controllers=morph(["target"], [0]),
                     animations=animated("morph-w(0)", [0, 1], [(.5,), (.5,)]))
    return {"normalized": morphed(tall, [.5], "NORMALIZED"), "relative": morphed(step, [.5], "RELATIVE"),
            "two_targets": morphed(tall, [.2, .3], "NORMALIZED", ("target", "other")),
            "skin_on_morph": on_skin, "animated_weight": moved,
            "baked": document(node(), geometries=geometry(points=half), effects=lit)}


def targets():
    """The same turn and shift at 0.5 s, named in every way that a channel can."""
    turn = '<translate sid="t">0 0 0</translate><rotate sid="r">0 0 1 0</rotate>'
    matrix = f'<matrix sid="m">{numbers(IDENTITY)}</matrix>'
    keys, angle, shift = [0, 1], [(0,), (60,)], [(0,), (.4,)]

    def stack(*channels):
        return document(node(transforms=turn), animations="".join(channels))
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    still = (c, -s, 0, .2, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    end = (math.cos(math.pi / 3), -math.sin(math.pi / 3), 0, .4, math.sin(math.pi / 3), math.cos(math.pi / 3),
           0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    moved = lambda first, second: animated("n/t" + first, keys, shift) + animated(  # noqa: E731
        "n/r" + second, keys, angle, id="b")
    return {
        "members": stack(moved(".X", ".ANGLE")),
        "indices": stack(moved("(0)", "(3)")),
        "whole": stack(animated("n/t", keys, [(0, 0, 0), (.4, 0, 0)], params="XYZ"),
                       animated("n/r", keys, [(0, 0, 1, 0), (0, 0, 1, 60)], params=["X", "Y", "Z", "ANGLE"], id="b")),
        "matrix_linear": document(node(transforms=matrix),
                                  animations=animated("n/m", keys, [IDENTITY, end], params=["TRANSFORM"])
                                  .replace('type="float"/></accessor></technique_common></source>\n<source id="a-k"',
                                           'type="float4x4"/></accessor></technique_common></source>\n<source id="a-k"')),
        "matrix_elements": document(node(transforms=f'<matrix sid="m">{numbers(still[:3])} 0 {numbers(still[4:])}'
                                                    "</matrix>"),
                                    animations=animated("n/m(3)(0)", keys, shift)),
        "still": document(node(transforms=f"<matrix>{numbers(still)}</matrix>")),
    }


def curves():
    """A straight line from 0 to 60 degrees, drawn by every interpolation that can."""
    turn = '<rotate sid="r">0 0 1 0</rotate>'
    keys, values = [0, 1], [(0,), (60,)]

    def drawn(**words):
        return document(node(transforms=turn), animations=animated("n/r.ANGLE", keys, values, **words))
    two = ([(-1 / 3, -20), (2 / 3, 40)], [(1 / 3, 20), (4 / 3, 80)])
    return {"linear": drawn(),
            "bezier_2d": drawn(interpolation="BEZIER", tangents=two),
            "bezier_1d": drawn(interpolation="BEZIER", tangents=([(20,), (20,)], [(20,), (20,)])),
            "hermite_1d": drawn(interpolation="HERMITE", tangents=([(60,), (60,)], [(60,), (60,)])),
            "mixed": document(node(transforms=turn), animations=animated(
                "n/r.ANGLE", [0, .25, 1], [(0,), (15,), (60,)], interpolation=["STEP", "LINEAR", "STEP"]))}


def armatures():
    """A posed skeleton and its skin below what moves both: that counts once, wherever the skin stands."""
    place = (0, -.7, 0, .2, .7, 0, 0, .1, 0, 0, .7, 0, 0, 0, 0, 1)
    lit = effect("<constant><emission><color>.8 .5 .2 1</color></emission></constant>")
    use = node(shown("#skin", kind="controller", skeleton="<skeleton>#bone-low</skeleton>"))
    tree = joints(25).replace('type="JOINT">', 'type="JOINT"><translate>.1 .2 0</translate>', 1)

    def seen(nodes, **parts):
        return document(nodes, effects=lit, controllers=skin(["low", "high"]), **parts)
    arm = f'<node id="arm"><matrix>{numbers(place)}</matrix>{{}}</node>'
    return {"outside": seen(arm.format(tree) + use), "inside": seen(arm.format(tree + use)),
            "of_a_library": seen('<node id="n2">' + arm.format('<instance_node url="#rig"/>') + "</node>",
                                 library_nodes=f'<node id="rig">{tree}{use}</node>'),
            "below_the_joint": seen(arm.format(tree.replace("0</translate>", f"0</translate>{use}", 1)))}


def mirrors():
    """A house turned inside out by its points, its node, its joints, its bind shape: lit from outside."""
    flip = "<scale>-1 1 1</scale>"
    mirror = (-1, *IDENTITY[1:])
    use = shown("#skin", kind="controller", skeleton="<skeleton>#bone-low</skeleton>")
    both = ["low", "high"]

    def shape(matrix):
        return f"<bind_shape_matrix>{numbers(matrix)}</bind_shape_matrix>"
    bones = joints(0)
    half = (.5, *IDENTITY[1:])
    return {"node": document(node(transforms=flip)),
            "joints": document(f'<node id="arm">{flip}{bones}</node>{node(use)}', controllers=skin(both)),
            "bind_shape": document(bones + node(use), controllers=skin(both, shape=shape(mirror))),
            "twice": document(f'<node id="arm">{flip}<scale>2 1 1</scale>{bones}</node>' + node(use, flip),
                              controllers=skin(both, shape=shape(half))),
            "morph": document(node(shown("#morph", kind="controller"), flip),
                              geometries=geometry() + geometry(id="target"),
                              controllers=morph(["target"], [.5]))}


def masks():
    """How opaque a texture makes is what its file holds, not what it looks like."""
    grey = png([[(64, 64, 64)] * 2] * 2)
    half = "<diffuse><color>.8 .5 .2 1</color></diffuse>"
    quarter = f"<color>{numbers([64 / 255] * 4)}</color>"

    def seen(inside):
        return textured(texture="", path="grey.png").replace(
            "<diffuse></diffuse>", f'{half}<transparent opaque="RGB_ZERO">{inside}</transparent>')
    return {"texture": seen('<texture texture="map-sampler" texcoord="UV"/>'), "color": seen(quarter),
            "grey.png": grey}


def display_colours():
    """A texture and a colour of the same numbers are the same light."""
    grey = png([[(64, 128, 200)] * 2] * 2)

    def seen(inside):
        return textured(texture=inside, path="grey.png").replace("lambert>", "constant>").replace(
            "diffuse>", "emission>")
    return {"texture": seen('<texture texture="map-sampler" texcoord="UV"/>'),
            "color": seen(f"<color>{numbers((64 / 255, 128 / 255, 200 / 255))} 1</color>"), "grey.png": grey}


def legacy_colours():
    """--color legacy: the numbers of files are those of the picture."""
    return display_colours()


def colours():
    """One colour as a literal, a parameter, a material's parameter, a texture of nothing else."""
    param = '<newparam sid="c"><float4>1 0 1 1</float4></newparam>'
    other = param.replace("1 0 1 1", "0 1 0 1")
    ref = '<lambert><diffuse><param ref="c"/></diffuse></lambert>'
    one = [[(255, 0, 255)] * 2] * 2
    return {"color": plain(effects=effect(LAMBERT.replace(".8 .5 .2 1", "1 0 1 1"))),
            "param": plain(effects=effect(ref, params=param)),
            "setparam": plain(effects=effect(ref, params=other), materials=material(
                setparams='<setparam ref="c"><float4>1 0 1 1</float4></setparam>')),
            "texture": textured(path="one.png"), "one.png": png(one)}


def opacities():
    """A quarter opaque by each of the four modes."""
    def seen(mode, color):
        return plain(effects=effect('<lambert><diffuse><color>.8 .5 .2 1</color></diffuse><transparent '
                                    f'opaque="{mode}"><color>{color}</color></transparent><transparency>'
                                    '<float>.5</float></transparency></lambert>'))
    return {"a_one": seen("A_ONE", "0 0 0 .5"), "a_zero": seen("A_ZERO", "0 0 0 1.5"),
            "rgb_one": seen("RGB_ONE", ".5 .5 .5 0"), "rgb_zero": seen("RGB_ZERO", "1.5 1.5 1.5 0")}


def image_files():
    """One picture in formats that keep it exactly, and embedded."""
    rows = picture()
    hex_text = "".join(f"{b:02x}" for b in png(rows))
    embedded = textured(version="1.5.0").replace("<ref>map.png</ref>", f'<hex format="PNG">{hex_text}</hex>')
    found = {"png": textured(), "tga": textured(path="map.tga"), "bmp": textured(path="map.bmp"),
             "tiff": textured(path="map.tif"), "dds": textured(path="map.dds"), "embedded": embedded}
    return found | {"map.png": png(rows), "map.tga": tga(rows), "map.bmp": bmp(rows), "map.tif": tiff(rows),
                    "map.dds": dds(rows)}


def texture_coordinates():
    """The set that bind_vertex_input names, by number or silence; without it, the one there is. Of two with
    one number the first."""
    def twice(set):
        return textured(geometries=geometry(triangles().replace(
            ' set="0"/>', f'{set}/><input semantic="TEXCOORD" source="#house-n" offset="1"{set}/>')))
    def called(name):
        return textured(geometries=geometry(triangles().replace('"TEXCOORD"', f'"{name}"')))
    return {"missing_set": textured(inside=UV.replace('input_set="0"', 'input_set="3"')),
            "missing_semantic": textured(inside=UV.replace('"TEXCOORD"', '"UVMap"')),
            "by_uv": called("UV"), "by_number": called("TEXCOORD0"), "twice": twice(' set="0"'), "twice_without_set": twice(""), "bound": textured(), "no_set": textured(inside=UV.replace(' input_set="0"', "")),
            "unbound": textured(inside=""),
            "direct_image": textured(texture='<texture texture="map" texcoord="UV"/>'),
            "no_texcoord": textured(texture='<texture texture="map-sampler"/>'),
            "map.png": png(picture())}


def images_without_file():
    """Checks, as for a file that is not there."""
    inside = "<init_from>map.png</init_from>"
    return {"missing": textured(path="none.png"), "empty": textured(path=""),
            "absent": textured().replace(inside, "")}


def linear(v):  # IEC 61966-2-1
    return v / 12.92 if v <= .04045 else ((v + .055) / 1.055) ** 2.4


def display(v):
    return 12.92 * v if v <= .0031308 else 1.055 * v ** (1 / 2.4) - .055


def by_tool(tool, text):
    return text.replace("<created>", f"<contributor><authoring_tool>{tool}</authoring_tool></contributor><created>", 1)


def emissions():
    """Blender before 2.80 wrote a factor of the diffuse colour, whatever its version is called. (Without its
    lamps, which are read in other units.)"""
    diffuse = (.8, .5, .2)

    def seen(glow, tool=""):
        text = plain(lights="", light_nodes="", effects=effect(f"<phong><emission><color>{numbers(glow)} 1</color></emission><diffuse><color>"
                                    f"{numbers(diffuse)} 1</color></diffuse></phong>"))
        return by_tool(tool, text) if tool else text
    light = [display(.3 * linear(v)) for v in diffuse]
    return {"light": seen(light), "since": seen(light, "Blender 2.80.75 commit date:2019-07-29"),
            "before": seen([.3] * 3, "Blender 2.79.0 commit date:2018-03-22, commit time:14:10, hash:f4dc9f9d68b"),
            "old": seen([.3] * 3, "Blender 2.63.0 r45996"),
            "oldest": seen([.3] * 3, "Blender v:249 - Illusoft Collada Exporter v:0.3.162"),
            "other": seen(light, "Collada Exporter for Blender 2.6+, by Juan Linietsky (juan@codenix.com)")}


def textured_emissions():
    """All of a diffuse texture's light."""
    both = ("<lambert><emission>{}</emission><diffuse><texture texture=\"map-sampler\" texcoord=\"UV\"/></diffuse>"
            "</lambert>")
    whole = textured(lights="", light_nodes="")
    slot = '<lambert><diffuse><texture texture="map-sampler" texcoord="UV"/></diffuse></lambert>'
    return {"light": whole.replace(slot, both.format('<texture texture="map-sampler" texcoord="UV"/>')),
            "factor": by_tool("Blender 2.72.0", whole.replace(slot, both.format("<color>1 1 1 1</color>"))),
            "map.png": png(picture())}


def vertex_colours():
    """They multiply the material's light, and the default one's; alpha does nothing."""
    def coloured(rgba, **parts):
        rows = "".join(f"{v} " for v in rgba * len(POINTS))
        colors = (f'<source id="house-c"><float_array id="house-c-array" count="{4 * len(POINTS)}">{rows}</float_array>'
                  f'<technique_common><accessor source="#house-c-array" count="{len(POINTS)}" stride="4">'
                  + "".join(f'<param name="{p}" type="float"/>' for p in "RGBA") + "</accessor></technique_common></source>")
        mesh = geometry(triangles().replace(" set=\"0\"/>", ' set="0"/><input semantic="COLOR" source="#house-c" '
                                            'offset="0" set="0"/>', 1)).replace("<vertices", colors + "<vertices", 1)
        return plain(geometries=mesh, **parts)
    tinted = [display(linear(v) * linear(w)) for v, w in zip((.8, .5, .2), (.5, 1, .75))]
    body = lambda rgb: effect(f"<lambert><diffuse><color>{numbers(rgb)} 1</color></diffuse></lambert>")  # noqa: E731
    return {"colour": plain(effects=body(tinted)), "tint": coloured((.5, 1, .75, .1)),
            "tint_of_white": coloured((*tinted, 1), effects=body((1, 1, 1)))}


def kept():
    """What a picture is not made of changes none: layers, physics, names, extras of others."""
    whole = plain()
    layered = document(node().replace('id="n"', 'id="n" layer="a b" name="the house"'),
                       evaluate='<evaluate_scene><render camera_node="#eye-node"><layer>other</layer></render>'
                                "</evaluate_scene>\n")
    extra = whole.replace('<node id="n">', '<node id="n">').replace(
        "</visual_scene>", '<extra type="x"><technique profile="NOBODY"><y z="1">2</y></technique></extra>'
        "</visual_scene>")
    physics = whole.replace('<library_visual_scenes>', '<library_physics_materials><physics_material id="pm">'
                            "<technique_common><dynamic_friction>1</dynamic_friction></technique_common>"
                            "</physics_material></library_physics_materials>\n<library_visual_scenes>")
    return {"plain": whole, "layers": layered, "extra": extra, "physics": physics}


FAMILIES = {f.__name__: f for f in (
    primitives, inputs, solids, polygons_with_holes, transforms, cameras_by_lookat, skews, references, bases, absolute_references,
    samplers, versions, units, assets, normals, smooth_sides, flat_sides, smoothed_sides, flattened_sides, only_materials,
    archives, fields_of_view, magnifications, instances, skins, skin_spaces, armatures, mirrors, morphs, targets, curves, colours, opacities, masks, display_colours, legacy_colours,
    image_files, texture_coordinates, images_without_file, emissions, textured_emissions, vertex_colours, kept)}
OPTIONS = {"smoothed_sides": ["--smooth", "50", "--time", "0"], "flattened_sides": ["--smooth", "0", "--time", "0"],
           "skin_spaces": ["--time", "1"], "targets": ["--time", "0.5"], "curves": ["--time", "0.5"], "morphs": ["--time", "0.5"],
           "legacy_colours": ["--color", "legacy", "--time", "0"]}
