#!/usr/bin/env python3
"""tests/first_look/corpus.py FOLDER: writes documents in the manner of other people's exporters, and FOLDER/corpus.json.

Each document is a plausible model with something that exporters are known to do. corpus.json says what is expected of each: "nothing":
it holds nothing to draw (exit 3); "told": its own lights or cameras spoil the picture and rendering must print this text; "missing":
its image exists nowhere; "least": the share of the picture it covers where no face is missing; "warmth": its red over its
blue where its material is used. Everything else must give a right picture (first_look.py).
"""
import json
import math
import random
import sys
import zipfile
from pathlib import Path

import shapes
from dae import Document, Look, extra, matrix, nums, rotate, source, translate

CORPUS = []  # (path, function, expectations)
GREY = (0.588, 0.588, 0.588)
WHITE, BLACK = (1, 1, 1), (0, 0, 0)
PAINT = {
    "paint": (0.7, 0.15, 0.1),
    "metal": (0.55, 0.55, 0.58),
    "rubber": (0.08, 0.08, 0.08),
    "glass": (0.3, 0.4, 0.5),
    "glow": (1, 0.95, 0.8),
    "red": (0.75, 0.1, 0.08),
    "wood": (0.5, 0.33, 0.18),
    "cloth": (0.25, 0.32, 0.55),
    "wall": (0.8, 0.77, 0.7),
    "roof": (0.55, 0.25, 0.18),
    "grass": (0.3, 0.45, 0.2),
    "floor": (0.45, 0.45, 0.43),
    "skin": (0.85, 0.64, 0.52),
    "hair": (0.15, 0.09, 0.05),
    "trousers": (0.15, 0.16, 0.25),
    "shoes": (0.1, 0.08, 0.06),
    "fur": (0.55, 0.4, 0.25),
    "green": (0.15, 0.45, 0.2),
    "gold": (0.8, 0.6, 0.2),
    "bark": (0.35, 0.25, 0.17),
    "leaves": (0.25, 0.5, 0.2),
}
SUN = "<constant_attenuation>1</constant_attenuation><linear_attenuation>0</linear_attenuation><quadratic_attenuation>0.000556</quadratic_attenuation>"


def document(path, **expected):
    def keep(function):
        CORPUS.append((path, function, expected))
        return function

    return keep


def picture(root, path, pixel, size=64, channels=3):
    path = root / path
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.exists():
        return
    pixel = shapes.paint_of(pixel) if isinstance(pixel, str) else pixel
    if path.suffix in (".tga", ".bmp"):
        {".tga": shapes.tga, ".bmp": shapes.bmp}[path.suffix](path, size, size, pixel)
    else:
        shapes.png(path, size, size, pixel, channels)


def palette_of(mesh, **changes):
    return {name: changes.get(name, PAINT[name]) for name in mesh.materials()}


# Gazebo: models/NAME/meshes/NAME.dae, pictures in ../materials/textures ---------------------------------------------------------------


def gazebo(
    root,
    name,
    mesh,
    textures,
    reference="../materials/textures/{}",
    files=None,
    tool="Blender v:249 - Illusoft Collada Exporter v:0.3.162",
    meter=1,
    unit="meter",
    up="Z_UP",
    look=None,
    **ways,
):
    """textures: material -> (file, picture); reference says how the file is named."""
    d = Document(tool, meter, unit, up)
    for material, (file, pixel) in textures.items():
        picture(root, f"gazebo/{name}/" + (files or "materials/textures/{}").format(file), pixel)
        d.image(f"{material}_image", reference.format(file))
        d.look(
            material,
            Look(
                diffuse=f"{material}_image",
                **(
                    look
                    or {
                        "model": "phong",
                        "ambient": (0.5, 0.5, 0.5),
                        "specular": (0.25, 0.25, 0.25),
                        "shininess": 12.5,
                    }
                ),
            ),
        )
    d.palette(
        {m: c for m, c in palette_of(mesh).items() if m not in textures},
        model="phong",
        ambient=BLACK,
        specular=(0.5, 0.5, 0.5),
        shininess=50,
    )
    d.show(name, mesh, **ways)
    return d


@document("gazebo/bookshelf/meshes/bookshelf.dae")
def bookshelf(root):
    return gazebo(
        root,
        "bookshelf",
        shapes.shelf(),
        {"wood": ("bookshelf_wood.png", "planks")},
        kind="polygons",
        symbol=lambda m: f"{m}_png",
    )


@document("gazebo/construction_cone/meshes/construction_cone.dae")
def construction_cone(root):
    d = gazebo(
        root, "construction_cone", shapes.cone(), {"red": ("cone.png", "livery")}, kind="polylist", normals="smooth"
    )
    d.light(
        "Lamp",
        "point",
        WHITE,
        matrix((-0.29, -0.77, 0.57, 4.08, 0.955, -0.2, 0.22, 1.0, -0.05, 0.6, 0.79, 5.9, 0, 0, 0, 1)),
        SUN,
    )
    d.camera(
        "Camera",
        matrix(
            (0.6859, -0.324, 0.6515, 7.4811, 0.7277, 0.3054, -0.6142, -6.5076, 0, 0.8954, 0.4453, 5.3437, 0, 0, 0, 1)
        ),
    )
    return d


@document("gazebo/drum/meshes/drum.dae")
def drum(root):
    return gazebo(
        root,
        "drum",
        shapes.barrel(),
        {"paint": ("drum.png", "livery")},
        meter=0.01,
        unit="centimeter",
        up="Y_UP",
        normals="smooth",
    )


@document("gazebo/house_1/meshes/house_1.dae")
def house_1(root):
    return gazebo(
        root,
        "house_1",
        shapes.house(),
        {"wall": ("House_1_Diffuse.png", "brick"), "grass": ("Grass.png", "grass")},
        tool="Google SketchUp 8.0.11752",
        meter=0.0254,
        unit="inch",
        both=True,
    )


@document("gazebo/jersey_barrier/meshes/jersey_barrier.dae")
def jersey_barrier(root):
    outline = [(-0.3, 0), (0.3, 0), (0.3, 0.1), (0.12, 0.35), (0.08, 0.85), (-0.08, 0.85), (-0.12, 0.35), (-0.3, 0.1)]
    return gazebo(
        root,
        "jersey_barrier",
        shapes.prism(outline, -1.9, 1.9, 0, "wall"),
        {"wall": ("jersey barrier.png", "steel")},
        reference="../materials/textures/jersey%20barrier.png",
    )


@document("gazebo/dumpster/meshes/dumpster.dae")
def dumpster(root):
    body = shapes.prism([(-0.8, 0.1), (0.7, 0.1), (1.0, 1.2), (-1.0, 1.4)], -1.5, 1.5, 0, "paint").join(
        shapes.prism([(-1.05, 1.4), (1.05, 1.2), (1.05, 1.26), (-1.05, 1.46)], -1.52, 1.52, 0, "rubber")
    )
    # Written on Windows: the name's case differs from the file's.
    return gazebo(
        root,
        "dumpster",
        body,
        {"paint": ("Dumpster_Diffuse.png", "steel")},
        reference="../materials/textures/dumpster_diffuse.PNG",
    )


@document("gazebo/pickup/meshes/pickup.dae")
def pickup(root):
    d = Document("Blender 2.71.0", 1, "meter")
    picture(root, "gazebo/pickup/materials/textures/pickup.png", "livery")
    d.image("pickup_png", "..\\materials\\textures\\pickup.png")
    d.look(
        "paint",
        Look(
            diffuse="pickup_png", model="phong", emission=BLACK, ambient=BLACK, specular=(0.5, 0.5, 0.5), shininess=50
        ),
    )
    d.palette({m: PAINT[m] for m in ("cloth", "glass", "metal", "rubber")}, model="phong", ambient=BLACK)
    body = shapes.truck().split()
    wheels = body.pop("rubber")
    for name, part in body.items():
        d.show(f"pickup_{name}", part, kind="polylist")
    d.mesh("wheels", wheels)
    d.put("nodes", d.node("wheel_set", f'<instance_geometry url="#wheels">{d.bind(["rubber"])}</instance_geometry>'))
    d.add(d.node("left", '<instance_node url="#wheel_set"/>', "<scale>1 1 1</scale>"))
    return d


@document("gazebo/willowgarage/meshes/willowgarage.dae")
def willowgarage(root):
    return gazebo(root, "willowgarage", shapes.room(), {}, tool="COLLADA Mixamo exporter", normals="none", uv=False)


@document("gazebo/heightmap/meshes/heightmap.dae")
def heightmap(root):
    ground = shapes.land(129, 32, shapes.hills, "grass", 8)
    return gazebo(
        root,
        "heightmap",
        ground,
        {"grass": ("grass_dry.png", "grass")},
        kind="triangles",
        normals="vertices",
        one_index=True,
    )


@document("gazebo/person_walking/meshes/walk.dae")
def person_walking(root):
    d = Document("FBX COLLADA exporter", 0.01, "centimeter", "Y_UP")
    picture(root, "gazebo/person_walking/materials/textures/person.png", "fabric")
    d.image("person", "..//materials//textures//person.png")
    d.look("cloth", Look(diffuse="person", model="phong", ambient=BLACK, specular=(0.1, 0.1, 0.1), shininess=8))
    mesh = shapes.person(0.4)
    d.palette({m: c for m, c in palette_of(mesh).items() if m != "cloth"}, ambient=BLACK)
    d.skin("person", mesh, PERSON, person_joint, ["hips"], normals="smooth")
    return d


PERSON = {
    "hips": (None, (0, 0, 0.95)),
    "spine": ("hips", (0, 0, 1.2)),
    "head": ("spine", (0, 0, 1.52)),
    "l_arm": ("spine", (-0.2, 0, 1.42)),
    "r_arm": ("spine", (0.2, 0, 1.42)),
    "l_leg": ("hips", (-0.09, 0, 0.92)),
    "r_leg": ("hips", (0.09, 0, 0.92)),
}
DOG = {"root": (None, (0, 0, 0.48)), "neck": ("root", (0, -0.45, 0.5)), "tail": ("root", (0, 0.45, 0.5))}


def person_joint(p):
    if p[2] > 1.5:
        return "head"
    if abs(p[0]) > 0.2 and p[2] > 1.0:
        return "l_arm" if p[0] < 0 else "r_arm"
    if p[2] < 0.92:
        return "l_leg" if p[0] < 0 else "r_leg"
    return "spine" if p[2] > 1.15 else "hips"


def dog_joint(p):
    return "neck" if p[1] < -0.46 else "tail" if p[1] > 0.44 else "root"


@document("gazebo/quadrotor/meshes/quadrotor_base.dae")
def hector_quadrotor(root):
    mesh = shapes.quadrotor()
    d = Document("Blender 2.61.4 r43829", 1, "meter")
    d.palette(palette_of(mesh), model="phong", ambient=BLACK, specular=(0.2, 0.2, 0.2), shininess=50)
    for name, part in mesh.split().items():
        d.show(
            f"quad_{name}",
            part,
            matrix((0.02, 0, 0, 0, 0, 0.02, 0, 0, 0, 0, 0.02, 0, 0, 0, 0, 1), "transform"),
            scale=50,
            normals="smooth",
            symbol=lambda m: f"{m}_001",
        )
    return d


@document("gazebo/table_marble/meshes/table_lightmap.dae")
def table_lightmap(root):
    # Indices of TEXCOORD go through the second set; wood is a picture in the parent's folder of its own.
    return gazebo(
        root,
        "table_marble",
        shapes.table(),
        {"wood": ("marble.png", "steel"), "metal": ("legs.png", "steel")},
        reference="../media/{}",
        files="media/{}",
        uv_set="1",
        meter=0.0254,
        unit="inch",
    )


@document("gazebo/suv/meshes/suv.dae")
def suv(root):
    d = gazebo(
        root, "suv", shapes.car(), {"paint": ("suv.png", "livery")}, reference="file://../materials/textures/{}"
    )
    d.light("Lamp", "directional", WHITE, rotate("X", 37) + rotate("Y", 3))
    return d


@document("gazebo/mailbox/meshes/mailbox.dae")
def mailbox(root):
    # The model names the picture without a folder; it lies in materials/textures.
    mesh = shapes.block(0, 0, 0.5, 0.08, 0.08, 1.0, "wood").join(
        shapes.cylinder((0, -0.22, 1.1), (0, 0.22, 1.1), 0.13, 16, "paint")
    )
    return gazebo(
        root, "mailbox", mesh, {"paint": ("mailbox.png", "livery"), "wood": ("post.png", "planks")}, reference="{}"
    )


# Links of URDF robots -----------------------------------------------------------------------------------------------------------------


def link(mesh, tool="Assimp Exporter", meter=1, unit="meter", up="Z_UP", looks=None, **ways):
    d = Document(tool, meter, unit, up)
    if looks is None:
        d.palette(
            palette_of(mesh),
            model="phong",
            emission=BLACK,
            ambient=BLACK,
            specular=(0.5, 0.5, 0.5),
            shininess=50,
            sids=True,
        )
    else:
        for name, look in looks.items():
            d.look(name, look)
    d.show("link", mesh, **ways)
    return d


@document("urdf/ur/visual/forearm.dae")
def ur_forearm(root):
    return link(shapes.arm_link(0.39, 0.05), "Blender 2.63.0 r45996", normals="smooth", kind="polylist")


@document("urdf/mm_base/base_link.dae")
def mm_base(root):
    # Modelled in millimetres, exported as metres: the link of 0.66 m is 660 wide.
    return link(shapes.rover(), meter=1, scale=1000, normals="none", uv=False)


@document("urdf/tiny/finger_tip.dae")
def tiny_tip(root):
    return link(shapes.bolt(), meter=1, scale=0.0006, normals="smooth", uv=False, digits=9)


@document("urdf/solidworks/torso.dae")
def far_torso(root):
    # An assembly's origin: the part lies 80 of its own sizes away.
    return link(
        shapes.robot_arm(),
        "VCGLab | MeshLab",
        offset=(41.2, -63.0, 25.5),
        normals="none",
        looks={m: Look(diffuse=PAINT[m]) for m in ("rubber", "paint", "metal")},
    )


@document("urdf/unbound/wheel.dae")
def unbound(root):
    mesh = shapes.cylinder((-0.06, 0, 0), (0.06, 0, 0), 0.17, 24, "rubber").join(
        shapes.cylinder((-0.065, 0, 0), (0.065, 0, 0), 0.08, 12, "metal")
    )
    d = Document("Blender 2.59.0", 1)
    d.palette(palette_of(mesh))
    d.show("wheel", mesh, bind="")
    return d


@document("urdf/one_material/gripper.dae", warmth=1.4)
def one_material(root):
    mesh = shapes.robot_arm().named("paint")
    d = Document("pycollada", 1)
    d.look(
        "paint", Look(diffuse=(0.9, 0.55, 0.1), model="phong", ambient=BLACK, specular=(0.2, 0.2, 0.2), shininess=20)
    )
    d.mesh("gripper", mesh, symbol=None)
    d.add(
        d.node(
            "node0",
            f'<instance_geometry url="#gripper">{d.bind(["paint"], lambda m: "materialref")}</instance_geometry>',
        )
    )
    return d


@document("urdf/vertex_colours/head.dae")
def vertex_colours(root):
    mesh = shapes.ball(0, 0, 0.15, 0.12, 0.11, 0.14, 16, 10, "default").join(
        shapes.cylinder((0, -0.14, 0.17), (0, -0.08, 0.17), 0.035, 14, "default")
    )
    d = Document("VCGLab | MeshLab", 1, up="Y_UP")
    d.mesh(
        "shape0-lib",
        mesh,
        normals="none",
        uv=False,
        symbol=None,
        colours=lambda p: (0.2 + 2 * p[2], 0.5, 0.9 - 2 * p[2], 1),
    )
    d.add(d.node("VisualSceneNode-node", '<instance_geometry url="#shape0-lib"/>'))
    return d


@document("urdf/white/cover.dae")
def white_cover(root):
    return link(
        shapes.arm_link(0.3, 0.07),
        looks={
            m: Look(diffuse=WHITE, ambient=WHITE, model="phong", specular=WHITE, shininess=5)
            for m in ("paint", "metal")
        },
        normals="smooth",
    )


@document("urdf/nao/meshes/HeadPitch.dae")
def nao_head(root):
    mesh = shapes.ball(0, 0, 0.07, 0.06, 0.065, 0.065, 14, 10, "skin").join(
        shapes.cylinder((-0.07, 0, 0.07), (0.07, 0, 0.07), 0.028, 12, "red")
    )
    picture(root, "urdf/nao/texture/textureNAO.png", "livery")
    d = Document("FBX COLLADA exporter", 0.01, "centimeter", "Y_UP")
    d.image("file5", "../texture/textureNAO.png")
    d.look(
        "skin",
        Look(
            diffuse="file5",
            model="phong",
            ambient=BLACK,
            transparent=WHITE,
            opaque="RGB_ZERO",
            transparency=0,
            texcoord="CHANNEL0",
            direct=True,
        ),
    )
    d.palette({"red": PAINT["red"]}, transparent=WHITE, opaque="RGB_ZERO", transparency=0)
    d.show("head", mesh, normals="smooth", kind="polygons")
    return d


@document("urdf/nested/arm.dae")
def nested_arm(root):
    mesh = shapes.arm_link(0.4, 0.06)
    d = Document("SolidWorks by way of Blender 2.7", 0.001, "millimeter", "Y_UP")
    d.palette(palette_of(mesh), ambient=BLACK)
    d.mesh("seg", mesh, normals="smooth", up="Z_UP")
    bind = d.bind(mesh.materials())
    inner = ""
    for k in range(4):
        inner = d.node(
            f"joint{k}",
            f'<instance_geometry url="#seg">{bind}</instance_geometry>' + inner,
            translate(0, 0, 0 if k == 3 else 400) + rotate("Y", 25 if k < 3 else -30),
        )
    d.add(d.node("fix", inner, rotate("X", -90)))
    return d


@document("urdf/x_up/wheel_fork.dae")
def x_up(root):
    return link(shapes.rover(), "AutoCAD by way of colladator", 0.001, "millimeter", "X_UP", normals="flat")


@document("urdf/mirrored/left_leg.dae")
def mirrored_leg(root):
    mesh = shapes.robot_arm()
    d = Document("Blender 2.74", 1)
    d.palette(palette_of(mesh), ambient=BLACK, model="phong", specular=(0.3, 0.3, 0.3), shininess=30)
    d.show("leg", mesh, "<scale>-1 1 1</scale>", normals="smooth")
    return d


@document("urdf/laser/hokuyo.dae", told="--lights scene")
def hokuyo(root):
    mesh = (
        shapes.block(0, 0, 0.02, 0.05, 0.05, 0.04, "rubber")
        .join(shapes.cylinder((0, 0, 0.04), (0, 0, 0.065), 0.021, 20, "paint"))
        .join(shapes.cylinder((0, 0, 0.065), (0, 0, 0.071), 0.024, 20, "rubber"))
    )
    d = link(
        mesh,
        "Google SketchUp 7.1",
        0.0254,
        "inch",
        looks={
            "rubber": Look(diffuse=(0.02, 0.02, 0.02), transparent=WHITE, transparency=0),
            "paint": Look(diffuse=(0.9, 0.75, 0.1), transparent=WHITE, transparency=0),
        },
    )
    d.light("Lamp", "point", WHITE, translate(-300, -500, -800), SUN)
    return d


# SketchUp -----------------------------------------------------------------------------------------------------------------------------


def sketchup(
    root,
    name,
    mesh,
    textures,
    folder=None,
    reference=None,
    tool="Google SketchUp 8.0.16846",
    edges=True,
    transforms="",
    hidden=False,
    double=True,
    meter=0.0254,
    unit="inch",
    offset=(0, 0, 0),
):
    d = Document(tool, meter, unit)
    d.order = ["visual_scenes", "nodes", "geometries", "materials", "effects", "cameras", "images", "lights"]
    folder = folder or name
    for material, (file, pixel) in textures.items():
        picture(root, f"sketchup/{folder}/{file}", pixel)
        d.image(f"ID_{material}", (reference or folder + "/{}").format(file))
        d.look(material, Look(diffuse=f"ID_{material}"))
    glass = {"transparent": WHITE, "opaque": "A_ONE", "transparency": 0.45}
    for material in mesh.materials():
        if material not in textures:
            d.look(material, Look(diffuse=PAINT[material], **(glass if material == "glass" else {})))
    parts = ""
    for material, part in mesh.split().items():
        ident = f"ID{len(parts)}_{material}"
        d.mesh(
            ident,
            part,
            one_index=True,
            both=double,
            symbol=lambda m: "Material2",
            offset=tuple(c / meter for c in offset),
        )
        parts += (
            f'<instance_geometry url="#{ident}">{d.bind([material], lambda m: "Material2")}</instance_geometry>\n'
        )
    if edges:
        d.look("edge_color000255", Look(model="constant", transparent=(0, 0, 0, 1), opaque="A_ONE", transparency=1))
        d.mesh(
            "ID_edges",
            mesh,
            kind="lines",
            normals="none",
            uv=False,
            symbol=lambda m: "Material2",
            offset=tuple(c / meter for c in offset),
        )
        parts += f'<instance_geometry url="#ID_edges">{d.bind(["edge_color000255"], lambda m: "Material2")}</instance_geometry>\n'
    d.put("nodes", d.node("ID_component", parts))
    d.add(d.node("SketchUp", d.node("instance_0", '<instance_node url="#ID_component"/>', transforms)))
    return d


@document("sketchup/garage.dae")
def sk_garage(root):
    return sketchup(
        root,
        "garage",
        shapes.house(),
        {"wall": ("Brick_Rough.jpg.png", "brick")},
        transforms=matrix((1, 0, 0, 300, 0, 1, 0, -200, 0, 0, 1, 0, 0, 0, 0, 1)),
    )


@document("sketchup/models/untitled.dae")
def sk_untitled(root):
    # Downloaded from the warehouse: models/untitled.dae with its pictures in images/ beside models.
    d = sketchup(
        root,
        "untitled",
        shapes.house(),
        {"wall": ("texture0.png", "brick"), "roof": ("texture1.png", "planks")},
        folder="images",
        reference="../images/{}",
    )
    return d


@document("sketchup/tower.dae")
def sk_tower(root):
    d = sketchup(root, "tower", shapes.tower(), {}, tool="Google SketchUp 6.4.112")
    d.camera(
        "skp_camera_Last_Saved",
        matrix((0.83, 0.2, -0.52, -1250, -0.56, 0.34, -0.76, -1700, 0, 0.92, 0.39, 1350, 0, 0, 0, 1)),
        "<perspective><xfov>46.8264</xfov><aspect_ratio>1.76</aspect_ratio><znear>1</znear><zfar>1000</zfar></perspective>",
    )
    return d


@document("sketchup/geolocated.dae")
def sk_geo(root):
    return sketchup(
        root, "geolocated", shapes.column_temple(), {}, offset=(448251, 5411932, 35), tool="Trimble SketchUp Pro 2015"
    )


@document("sketchup/livingroom.dae")
def sk_room(root):
    d = sketchup(root, "livingroom", shapes.room(), {"floor": ("Wood_Floor_Light.png", "planks")})
    d.camera(
        "skp_camera_Scene_1",
        matrix((1, 0, 0, 0, 0, 0.17, -0.98, -68, 0, 0.98, 0.17, 62, 0, 0, 0, 1)),
        "<perspective><yfov>60</yfov><aspect_ratio>0</aspect_ratio><znear>1</znear><zfar>1000</zfar></perspective>",
    )
    return d


@document("sketchup/single_sided.dae")
def sk_single(root):
    # Faces drawn outwards in once: the normals of half the walls look inwards.
    mesh = shapes.house()
    mesh.faces = [
        (tuple(reversed(f)), m, tuple(reversed(uv))) if k % 2 else (f, m, uv)
        for k, (f, m, uv) in enumerate(mesh.faces)
    ]
    return sketchup(root, "single_sided", mesh, {}, double=False, edges=False)


@document("sketchup/glasshouse.dae")
def sk_glass(root):
    mesh = shapes.tower(4).named({"wall": "glass", "glass": "metal"})
    return sketchup(root, "glasshouse", mesh, {})


@document("sketchup/edges_only.dae", nothing=True)
def sk_edges(root):
    mesh = shapes.house()
    d = Document("Google SketchUp 7.0", 0.0254, "inch")
    d.look("edge", Look(model="constant", emission=BLACK))
    d.mesh("edges", mesh.named("edge"), kind="lines", normals="none", uv=False)
    d.add(d.node("SketchUp", f'<instance_geometry url="#edges">{d.bind(["edge"])}</instance_geometry>'))
    return d


@document("sketchup/stairs15.dae")
def sk_15(root):
    d = Document("SketchUp 14", 0.0254, "inch", version="1.5.0")
    mesh = shapes.stairs()
    d.palette(palette_of(mesh))
    d.show("stairs", mesh, kind="polylist", one_index=True)
    return d


@document("sketchup/forest.dae")
def sk_forest(root):
    picture(root, "sketchup/forest/leaf.png", shapes.leaf, 64, 4)
    mesh = shapes.tree()
    d = Document("Google SketchUp 8.0.4811", 0.0254, "inch")
    d.image("leaf", "forest\\leaf.png")
    d.look("leaves", Look(diffuse="leaf", transparent="leaf", opaque="A_ONE", transparency=1, double_sided=1))
    d.look("bark", Look(diffuse=PAINT["bark"]))
    d.mesh("tree", mesh, one_index=True)
    d.put(
        "nodes", d.node("ID_tree", f'<instance_geometry url="#tree">{d.bind(mesh.materials())}</instance_geometry>')
    )
    rng = random.Random(3)
    for k in range(9):
        a, s = rng.uniform(0, 6.28), rng.uniform(0.7, 1.3)
        d.add(
            d.node(
                f"t{k}",
                '<instance_node url="#ID_tree"/>',
                matrix(
                    (
                        s * math.cos(a),
                        -s * math.sin(a),
                        0,
                        160 * (k % 3),
                        s * math.sin(a),
                        s * math.cos(a),
                        0,
                        170 * (k // 3),
                        0,
                        0,
                        s,
                        0,
                        0,
                        0,
                        0,
                        1,
                    )
                ),
            )
        )
    return d


@document("sketchup/white_model.dae")
def sk_white(root):
    mesh = shapes.city(3, 3)
    d = Document("Google SketchUp 8.0", 0.0254, "inch")
    for m in mesh.materials():
        d.look(m, Look(diffuse=WHITE))
    d.show("white", mesh, both=True)
    return d


# 3ds Max ------------------------------------------------------------------------------------------------------------------------------

MAX = "OpenCOLLADA for 3ds Max;  Version: 1.4.1;  Revision: 1123;  Platform: x64;  Configuration: Release Max2012"
OLD_MAX = "3dsMax 9 - Feeling ColladaMax v3.05B."


def opencollada(mesh, looks, meter=0.0254, unit="inch", up="Z_UP", pivot=(0, 0, 0), **ways):
    d = Document(MAX, meter, unit, up, contributor="<author>user</author>")
    for name, look in looks.items():
        d.look(name, look)
    d.mesh("geom-Object01", mesh, **ways)
    inner = d.node(
        "node-pivot",
        f'<instance_geometry url="#geom-Object01">{d.bind(mesh.materials())}</instance_geometry>',
        matrix((1, 0, 0, pivot[0], 0, 1, 0, pivot[1], 0, 0, 1, pivot[2], 0, 0, 0, 1)),
    )
    d.add(
        d.node(
            "node-Object01",
            inner
            + extra(
                "OpenCOLLADA",
                '<cast_shadows sid="cast_shadows">1</cast_shadows><receive_shadows sid="receive_shadows">1</receive_shadows>',
            ),
            matrix((1, 0, 0, -pivot[0], 0, 1, 0, -pivot[1], 0, 0, 1, -pivot[2], 0, 0, 0, 1)),
        )
    )
    return d


def standard(mesh, **more):
    return {
        m: Look(diffuse=c, model="blinn", ambient=GREY, specular=(0.9, 0.9, 0.9), shininess=10, **more)
        for m, c in palette_of(mesh).items()
    }


@document("max/truck.dae")
def max_truck(root):
    mesh = shapes.truck()
    picture(root, "max/truck_diff.png", "livery")
    looks = standard(mesh, transparent=WHITE, opaque="A_ONE", transparency=1)
    d = opencollada(mesh, {}, pivot=(12, -30, 4), normals="smooth")
    d.image("truck_diff_png", "file:///D:/projects/game%20art/trucks/textures/truck_diff.png")
    looks["cloth"].diffuse = "truck_diff_png"
    for name, look in looks.items():
        d.look(name, look)
    return d


@document("max/teapot_shelf.dae")
def max_invisible(root):
    # ColladaMax wrote opacity as transparency: everything is invisible by the formula.
    mesh = shapes.table().join(shapes.mug().moved(0, 0, 0.76)).join(shapes.bottle().moved(0.3, 0.1, 0.76))
    d = Document(OLD_MAX, 0.0254, "inch")
    for name, look in standard(mesh, transparent=WHITE, opaque="A_ONE", transparency=0).items():
        d.look(name, look)
    d.show("Box01", mesh, kind="polygons")
    return d


@document("max/rgb_zero_one.dae")
def max_rgb_zero(root):
    mesh = shapes.plane()
    return opencollada(mesh, standard(mesh, transparent=WHITE, opaque="RGB_ZERO", transparency=1), normals="smooth")


@document("max/rgb_zero_black.dae")
def max_rgb_zero_black(root):
    mesh = shapes.ship()
    return opencollada(mesh, standard(mesh, transparent=BLACK, opaque="RGB_ZERO", transparency=1))


@document("max/no_transparent.dae")
def max_no_transparent(root):
    # Only <transparency>, 0, and no <transparent>.
    mesh = shapes.sofa()
    return opencollada(mesh, standard(mesh, transparency=0), normals="smooth", kind="polylist")


@document("max/castle/castle.dae")
def max_backslash(root):
    mesh = shapes.column_temple()
    picture(root, "max/castle/maps/Stone Wall.png", "brick")
    d = opencollada(mesh, {}, kind="polygons")
    d.image("StoneWall", "maps\\Stone Wall.png")
    d.look("wall", Look(diffuse="StoneWall", model="phong", ambient=GREY, specular=BLACK, shininess=0))
    d.look("roof", Look(diffuse=PAINT["roof"]))
    return d


@document("max/absolute/soldier.dae")
def max_absolute(root):
    mesh = shapes.person(0.2)
    picture(root, "max/absolute/Soldier_Body.png", "fabric")
    d = opencollada(mesh, {}, normals="smooth")
    d.image("body", "C:\\Users\\Ian\\My Documents\\maps\\Soldier_Body.png")
    for m in mesh.materials():
        d.look(
            m,
            Look(
                diffuse="body" if m in ("cloth", "trousers") else PAINT[m],
                model="blinn",
                ambient=GREY,
                shininess=10,
                specular=BLACK,
            ),
        )
    return d


@document("max/unc/barn.dae")
def max_unc(root):
    mesh = shapes.warehouse()
    picture(root, "max/unc/textures/planks_01.png", "planks")
    d = opencollada(mesh, {}, up="Z_UP")
    d.image("planks", "file://///server/art/textures/planks_01.png")
    for m in mesh.materials():
        d.look(m, Look(diffuse="planks" if m == "wall" else PAINT[m], model="blinn", ambient=GREY))
    return d


@document("max/far_camera.dae")
def max_far_camera(root):
    # The view's camera was left where another scene had been: the model is 900 m away.
    mesh = shapes.car()
    d = opencollada(mesh, standard(mesh), normals="smooth")
    d.camera("Camera01", translate(0, -36000, 500) + rotate("X", 90))
    return d


@document("max/camera_inside.dae")
def max_camera_inside(root):
    # The camera stands inside the body and looks up through the open roof's edge: it sees next to nothing.
    mesh = shapes.truck()
    d = opencollada(mesh, standard(mesh), normals="smooth")
    d.camera("Camera01", translate(0, 300, 4000) + rotate("X", 180))
    return d


@document("max/skewed.dae")
def max_skew(root):
    mesh = shapes.chair()
    d = opencollada(mesh, {})
    d.scene = ""
    for name, look in standard(mesh).items():
        d.look(name, look)
    d.add(
        d.node(
            "Chair01",
            f'<instance_geometry url="#geom-Object01">{d.bind(mesh.materials())}</instance_geometry>',
            translate(3, 4, 0) + "<skew>15 1 0 0 0 0 1</skew>" + rotate("Z", 30) + "<scale>1.5 1.5 1.5</scale>",
        )
    )
    return d


@document("max/lights_away.dae", told="--lights both")
def max_lights_away(root):
    mesh = shapes.car()
    d = opencollada(mesh, standard(mesh), normals="smooth")
    d.light("Direct01", "directional", WHITE, rotate("X", 180))
    return d


@document("max/black_ambient_light.dae")
def max_ambient_light(root):
    mesh = shapes.sofa()
    d = opencollada(mesh, standard(mesh), normals="smooth")
    d.put(
        "lights",
        '<light id="ambient-light" name="ambient"><technique_common><ambient><color>0 0 0</color></ambient></technique_common></light>\n',
    )
    d.add(d.node("ambient", '<instance_light url="#ambient-light"/>'))
    return d


# Maya ---------------------------------------------------------------------------------------------------------------------------------

MAYA = "Maya 8.0 | ColladaMaya v3.02 | FCollada v3.2"


def maya(mesh, looks=None, tool=MAYA, transforms=None, four=True, **ways):
    d = Document(tool, 0.01, "centimeter", "Y_UP")
    for name, look in (
        looks
        or {
            m: Look(
                diffuse=c,
                model="phong",
                emission=BLACK,
                ambient=BLACK,
                specular=(0.5, 0.5, 0.5),
                shininess=20,
                reflective=BLACK,
                reflectivity=0.5,
                transparent=BLACK,
                opaque="RGB_ZERO",
                transparency=1,
            )
            for m, c in palette_of(mesh).items()
        }
    ).items():
        d.look(name, look)
    if four:
        for name, place, lens in (
            (
                "persp",
                translate(2000, 1500, 2000) + rotate("Y", 45) + rotate("X", -28),
                "<perspective><yfov>37.8</yfov><aspect_ratio>1.5</aspect_ratio><znear>1</znear><zfar>1000000</zfar></perspective>",
            ),
            (
                "top",
                translate(0, 10000, 0) + rotate("X", -90),
                "<orthographic><xmag>3000</xmag><aspect_ratio>1.5</aspect_ratio><znear>1</znear><zfar>1000000</zfar></orthographic>",
            ),
        ):
            d.camera(name, place, lens)
    place = (
        transforms
        if transforms is not None
        else translate(0, 0, 0) + "".join(rotate(a, 0, f"rotate{a}") for a in "ZYX") + "<scale>1 1 1</scale>"
    )
    d.show("polySurface1", mesh, place, **ways)
    return d


@document("maya/villager.dae")
def maya_villager(root):
    return maya(shapes.person(0.6), normals="smooth", kind="polylist")


@document("maya/hound.dae")
def maya_hound(root):
    mesh = shapes.dog()
    d = Document(MAYA, 0.01, "centimeter", "Y_UP")
    d.palette(palette_of(mesh), model="lambert", ambient=BLACK, transparent=BLACK, opaque="RGB_ZERO", transparency=1)
    d.skin("hound", mesh, DOG, dog_joint, ["root_jnt"], ids=lambda n: f"{n}_jnt", normals="smooth")
    times, angles = (0, 0.5, 1, 1.5, 2), (-30, 20, -30, 20, -30)
    d.put(
        "animations",
        '<animation id="tail-rot"><source id="tail-in"><float_array id="tail-in-a" count="5">'
        + nums(times)
        + '</float_array><technique_common><accessor source="#tail-in-a" count="5"><param name="TIME" type="float"/></accessor></technique_common></source>'
        '<source id="tail-out"><float_array id="tail-out-a" count="5">'
        + nums(angles)
        + '</float_array><technique_common><accessor source="#tail-out-a" count="5"><param name="ANGLE" type="float"/></accessor></technique_common></source>'
        '<source id="tail-ip"><Name_array id="tail-ip-a" count="5">LINEAR LINEAR LINEAR LINEAR LINEAR</Name_array><technique_common><accessor source="#tail-ip-a" count="5"><param name="INTERPOLATION" type="Name"/></accessor></technique_common></source>'
        '<sampler id="tail-s"><input semantic="INPUT" source="#tail-in"/><input semantic="OUTPUT" source="#tail-out"/><input semantic="INTERPOLATION" source="#tail-ip"/></sampler><channel source="#tail-s" target="hound-node/rotY.ANGLE"/></animation>\n',
    )
    d.scene = d.scene.replace('name="hound-node">', 'name="hound-node"><rotate sid="rotY">0 1 0 0</rotate>')
    return d


@document("maya/rig_in_library.dae")
def maya_library_rig(root):
    # The joints are in library_nodes and come in by instance_node.
    mesh = shapes.person(0.3)
    d = Document("OpenCOLLADA for Maya", 0.01, "centimeter", "Y_UP")
    d.palette(palette_of(mesh), ambient=BLACK)
    tree, instance = d.skin("body", mesh, PERSON, person_joint, ["hips"], scene=False, normals="smooth")
    d.put("nodes", tree)
    d.add(d.node("rig", '<instance_node url="#hips"/>') + d.node("body-node", instance))
    return d


@document("maya/rig_never_instanced.dae")
def maya_loose_rig(root):
    # As above, and nothing instances the joints.
    mesh = shapes.dog()
    d = Document("OpenCOLLADA for Maya", 0.01, "centimeter", "Y_UP")
    d.palette(palette_of(mesh), ambient=BLACK)
    tree, instance = d.skin("body", mesh, DOG, dog_joint, ["root"], scene=False, normals="smooth")
    d.put("nodes", tree)
    d.add(d.node("body-node", instance))
    return d


@document("maya/vase.dae")
def maya_vase(root):
    mesh = shapes.lathe([(0.1, 0), (0.16, 0.1), (0.17, 0.25), (0.07, 0.4), (0.09, 0.48)], 20, "gold")
    return maya(
        mesh,
        {
            "gold": Look(
                diffuse=(0.8, 0.6, 0.2),
                model="blinn",
                ambient=BLACK,
                specular=(0.3, 0.3, 0.3),
                shininess=0.3,
                transparent=WHITE,
                opaque="RGB_ZERO",
                transparency=0,
            )
        },
        normals="smooth",
        tool="FBX COLLADA exporter",
    )


@document("maya/street.dae")
def maya_street(root):
    mesh = shapes.city(21, 4)
    picture(root, "maya/sourceimages/facade.png", "brick")
    d = maya(
        mesh,
        {
            m: Look(diffuse="facade" if m == "wall" else PAINT[m], model="lambert", ambient=BLACK, texcoord="TEX0")
            for m in mesh.materials()
        },
        four=False,
    )
    d.image("facade", "file:///home/artist/maya/projects/street/sourceimages/facade.png")
    picture(root, "maya/facade.png", "brick")
    return d


@document("maya/pivots.dae")
def maya_pivots(root):
    place = (
        translate(120, 0, -40)
        + '<translate sid="rotatePivot">0 45 0</translate>'
        + rotate("Z", 10)
        + rotate("Y", 35)
        + rotate("X", 0)
        + '<translate sid="rotatePivotInverse">0 -45 0</translate>'
        + "<scale>1 1.2 1</scale>"
    )
    return maya(shapes.chair(), transforms=place, kind="polygons")


@document("maya/chrome_plane.dae")
def maya_chrome(root):
    mesh = shapes.plane()
    return maya(
        mesh,
        {
            m: Look(
                diffuse=c,
                model="phong",
                ambient=BLACK,
                specular=WHITE,
                shininess=40,
                reflective=(0.5, 0.5, 0.5),
                reflectivity=0.5,
            )
            for m, c in palette_of(mesh).items()
        },
        normals="smooth",
    )


@document("maya/initial_shading_group.dae", warmth=1.4)
def maya_initial(root):
    # Symbols that nothing binds: initialShadingGroup.
    mesh = shapes.gear()
    d = Document(MAYA, 0.01, "centimeter", "Y_UP")
    d.look("lambert1", Look(diffuse=(0.9, 0.5, 0.1), ambient=BLACK))
    d.mesh("gear", mesh, symbol=lambda m: "initialShadingGroup")
    d.add(
        d.node(
            "gear1",
            f'<instance_geometry url="#gear">{d.bind(["lambert1"], lambda m: "lambert1SG")}</instance_geometry>',
        )
    )
    return d


@document("maya/lookat.dae")
def maya_lookat(root):
    # A camera straight above with up along the view.
    mesh = shapes.house()
    d = maya(mesh, four=False)
    d.camera("above", "<lookat>0 2400 0  0 0 0  0 1 0</lookat>")
    return d


# Blender ------------------------------------------------------------------------------------------------------------------------------


def blender(
    mesh,
    version="2.79.0 commit date:2018-03-22",
    energy=None,
    camera=True,
    model="phong",
    looks=None,
    lamp_at=(4.08, 1.0, 5.9),
    transforms="",
    **ways,
):
    d = Document(f"Blender {version}", contributor="<author>Blender User</author>")
    new = version >= "2.8"
    for name, look in (
        looks
        or {
            m: Look(
                diffuse=c,
                model="lambert" if new else model,
                emission=BLACK,
                ambient=None if new else BLACK,
                specular=(0.5, 0.5, 0.5),
                shininess=50,
                sids=True,
            )
            for m, c in palette_of(mesh).items()
        }
    ).items():
        d.look(name, look)
    if camera:
        d.camera(
            "Camera",
            matrix(
                (0.6859, -0.324, 0.6515, 7.36, 0.7277, 0.3054, -0.6142, -6.93, 0, 0.8954, 0.4453, 4.96, 0, 0, 0, 1),
                "transform",
            ),
            '<perspective><xfov sid="xfov">39.6</xfov><aspect_ratio>1.777778</aspect_ratio><znear sid="znear">0.1</znear><zfar sid="zfar">100</zfar></perspective>',
        )
    if energy is not None:
        x, y, z = lamp_at
        place = matrix((-0.29, -0.77, 0.566, x, 0.955, -0.2, 0.218, y, -0.055, 0.6, 0.79, z, 0, 0, 0, 1), "transform")
        rgb = (energy, energy, energy) if new else WHITE
        d.put(
            "lights",
            f'<light id="Light-light" name="Light"><technique_common><point><color sid="color">{nums(rgb)}</color><constant_attenuation>1</constant_attenuation><linear_attenuation>0</linear_attenuation><quadratic_attenuation>0.00111109</quadratic_attenuation></point></technique_common>'
            + extra(
                "blender",
                f'<type sid="type" type="int">0</type><energy sid="blender_energy" type="float">{energy}</energy><dist sid="blender_dist" type="float">29.99998</dist>',
            )
            + "</light>\n",
        )
        d.add(d.node("Light", '<instance_light url="#Light-light"/>', place, "NODE"))
    ways.setdefault("symbol", lambda m: f"{m}-material")
    d.show("Mesh", mesh, matrix((1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), "transform") + transforms, **ways)
    return d


@document("blender/rover_watts.dae")
def blender_watts(root):
    return blender(shapes.rover(), "2.83.1", energy=1000, normals="smooth", scale=4)


@document("blender/sun_watts.dae")
def blender_sun(root):
    mesh = shapes.house()
    d = blender(mesh, "2.92.0", camera=False)
    d.light(
        "Sun",
        "directional",
        (3, 3, 3),
        matrix((1, 0, 0, 0, 0, 0.77, 0.64, 0, 0, -0.64, 0.77, 10, 0, 0, 0, 1), "transform"),
        extra("blender", '<energy sid="blender_energy" type="float">3</energy>'),
    )
    return d


@document("blender/spot_watts.dae")
def blender_spot(root):
    d = blender(shapes.robot_arm(), "3.4.1", camera=False, scale=2, normals="smooth")
    d.light(
        "Spot",
        "spot",
        (500, 500, 500),
        matrix((1, 0, 0, 0.4, 0, 1, 0, 0, 0, 0, 1, 6, 0, 0, 0, 1), "transform"),
        "<constant_attenuation>1</constant_attenuation><quadratic_attenuation>0.00111109</quadratic_attenuation><falloff_angle>75</falloff_angle><falloff_exponent>0.15</falloff_exponent>",
    )
    return d


@document("blender/untouched_lamp.dae")
def blender_lamp(root):
    return blender(shapes.chair(), energy=1, scale=2)


@document("blender/lamp_below.dae", told="--lights scene")
def blender_lamp_below(root):
    ground = shapes.land(40, 16, lambda x, y: 0.5 * math.sin(x * 0.4) * math.cos(y * 0.3), "grass", 4)
    return blender(ground, energy=1, camera=False, lamp_at=(0, 0, -30), normals="smooth")


@document("blender/small_in_camera.dae")
def blender_small(root):
    # The default camera of a new file, and a model of 6 cm.
    return blender(shapes.mug(), camera=True, normals="smooth")


@document("blender/camera_away.dae")
def blender_away(root):
    # The model was moved; the camera looks at the empty origin.
    return blender(shapes.car(), transforms=translate(160, 40, 0), normals="smooth")


@document("blender/character.dae")
def blender_character(root):
    mesh = shapes.person(1.2)
    d = Document("Blender 2.78.0")
    d.palette(
        palette_of(mesh),
        model="phong",
        emission=BLACK,
        ambient=BLACK,
        specular=(0.5, 0.5, 0.5),
        shininess=50,
        sids=True,
    )
    tree, instance = d.skin(
        "Body",
        mesh,
        PERSON,
        person_joint,
        ["Armature_hips"],
        ids=lambda n: f"Armature_{n}",
        scene=False,
        normals="smooth",
        symbol=lambda m: f"{m}-material",
    )
    d.add(d.node("Armature", tree + d.node("Body-node", instance), translate(0, 0, 0) + rotate("Z", 90), "NODE"))
    return d


@document("blender/two_roots.dae")
def blender_roots(root):
    mesh = shapes.dog().join(shapes.dog().moved(0.8, 0.2, 0, 40))
    joints = {"a": (None, (0, 0, 0.48)), "b": (None, (0.8, 0.2, 0.48))}
    d = Document("Blender 2.66.1")
    d.palette(palette_of(mesh), ambient=BLACK)
    d.skin("dogs", mesh, joints, lambda p: "a" if p[0] < 0.35 else "b", ["a", "b"], normals="smooth")
    return d


@document("blender/blend_texture/crate.dae")
def blender_crate(root):
    picture(root, "blender/blend_texture/Crate_diffuse.png", "planks")
    mesh = shapes.crate()
    d = blender(
        mesh,
        looks={
            "wood": Look(diffuse="Crate_diffuse_png", model="phong", emission=BLACK, ambient=BLACK, texcoord="UVMap"),
            "metal": Look(diffuse=PAINT["metal"]),
        },
        camera=False,
        energy=1,
    )
    d.image("Crate_diffuse_png", "Crate_diffuse.png")
    return d


@document("blender/emission_only.dae")
def blender_emission(root):
    mesh = shapes.tower(3)
    return blender(
        mesh, "2.93.0", camera=False, looks={m: Look(diffuse=BLACK, emission=c) for m, c in palette_of(mesh).items()}
    )


# Torque and games ---------------------------------------------------------------------------------------------------------------------


def torque(mesh, joints, joint_of, roots, tool="Torque by way of 3dsMax", **ways):
    d = Document(tool, 1, "meter", "Z_UP")
    d.palette(palette_of(mesh), ambient=BLACK)
    tree, instance = d.skin("shape2", mesh, joints, joint_of, roots, scene=False, **ways)
    d.add(
        d.node("bounds", "", "<scale>2 2 2</scale>")
        + d.node(
            "base01",
            d.node("start01", tree + d.node("shape2-node", instance) + d.node("eye", "", translate(0, 0, 1.7)))
            + d.node("detail2", ""),
        )
    )
    return d


@document("torque/player.dae")
def torque_player(root):
    return torque(shapes.person(0.9), PERSON, person_joint, ["hips"], normals="smooth")


@document("torque/wolf.dae")
def torque_wolf(root):
    # Skeletons that name the same tree more than once, the leaf first.
    return torque(shapes.dog(), DOG, dog_joint, ["tail", "neck", "root"], normals="smooth", kind="polylist")


@document("torque/crate_collision.dae")
def torque_crate(root):
    mesh = shapes.crate()
    picture(root, "torque/crate_d.png", "planks")
    d = Document("Blender 2.49 with the Torque script", 1, "meter")
    d.image("crate_d", "./crate_d.png")
    d.look("wood", Look(diffuse="crate_d"))
    d.look("metal", Look(diffuse=PAINT["metal"]))
    d.show("crate2", mesh)
    d.mesh("Collision-1", shapes.block(0, 0, 0.5, 1, 1, 1, "none"), normals="none", uv=False, symbol=None)
    d.add(d.node("Col-1", '<instance_geometry url="#Collision-1"/>'))
    return d


@document("torque/door_v140.dae")
def torque_door(root):
    d = Document("Torque by way of Blender 2.4", 1, "meter", version="1.4.0")
    mesh = shapes.block(0, 0, 1.05, 0.9, 0.05, 2.1, "wood").join(
        shapes.block(0.38, -0.05, 1.0, 0.03, 0.06, 0.12, "metal")
    )
    for x in (-0.5, 0.5):
        mesh.join(shapes.block(x, 0, 1.08, 0.1, 0.14, 2.16, "wall"))
    d.palette(palette_of(mesh))
    d.show("door", mesh, kind="polygons")
    return d


@document("torque/rocks.dae")
def torque_rocks(root):
    rng, mesh = random.Random(8), shapes.Mesh()
    for k in range(6):
        rock = shapes.ball(0, 0, 0, 1, 0.8, 0.6, 10, 7, "wall")
        rock.points = [tuple(c * rng.uniform(0.85, 1.15) for c in p) for p in rock.points]
        mesh.join(rock.moved(2.1 * (k % 3), 1.9 * (k // 3), 0.4, 40 * k, rng.uniform(0.6, 1.2)))
    picture(root, "torque/Textures/Rock.png", "steel")
    d = Document("3dsMax", 1, "meter")
    d.image("rock", "textures/rock.png")  # the folder's and the file's case differ
    d.look("wall", Look(diffuse="rock", double_sided=1))
    d.show("rocks", mesh, normals="smooth")
    return d


@document("games/ark/levels/harbour.dae")
def game_harbour(root):
    # Nodes 5 deep, each with a scale.
    mesh = shapes.ship()
    d = Document("Unreal by way of FBX", 0.01, "centimeter", "Y_UP")
    d.palette(palette_of(mesh), ambient=BLACK, model="phong", specular=(0.1, 0.1, 0.1), shininess=10)
    d.mesh("ship", mesh, kind="polylist")
    inner = f'<instance_geometry url="#ship">{d.bind(mesh.materials())}</instance_geometry>'
    for k in range(5):
        inner = d.node(
            f"level{k}",
            inner,
            ("<scale>10 10 10</scale>" if k % 2 else "<scale>0.1 0.1 0.1</scale>") + rotate("Y", 20),
        )
    d.add(inner)
    return d


@document("games/sprite_tree.dae")
def game_tree(root):
    # Alpha of the diffuse texture, and no <transparent> at all.
    mesh = shapes.tree()
    picture(root, "games/images/leaf_alpha.png", shapes.leaf, 64, 4)
    d = Document("Unity by way of assimp", 1, "meter", "Y_UP")
    d.image("leaf", "leaf_alpha.png")
    d.look("leaves", Look(diffuse="leaf"))
    d.look("bark", Look(diffuse=PAINT["bark"]))
    d.show("tree", mesh, normals="flat")
    return d


@document("games/dark_knight.dae")
def game_knight(root):
    # Black diffuse and a texture in emission: lit maps of an old game.
    mesh = shapes.person(0.25)
    picture(root, "games/textures/knight.png", "steel")
    d = Document("Milkshape 3D", 1, "meter", "Y_UP")
    d.image("knight", "textures/knight.png")
    for m in mesh.materials():
        d.look(m, Look(diffuse=BLACK, ambient=BLACK, emission="knight"))
    d.show("knight", mesh, normals="smooth")
    return d


@document("games/missing_skin.dae", missing=True)
def game_missing(root):
    mesh = shapes.truck()
    d = Document("Milkshape 3D", 1, "meter", "Y_UP")
    d.image("skin", "skins/never_uploaded.tga")
    d.look("paint", Look(diffuse="skin"))
    d.palette({m: PAINT[m] for m in mesh.materials() if m != "paint"})
    d.show("truck", mesh)
    return d


@document("games/mixed_weights.dae")
def game_weights(root):
    # Weights that do not sum to 1, as old exporters wrote them.
    mesh = shapes.person(0.5)
    d = Document("Cinema 4D 11", 0.01, "centimeter", "Y_UP")
    d.palette(palette_of(mesh), ambient=(0.2, 0.2, 0.2))
    d.skin("hero", mesh, PERSON, person_joint, ["hips"], weights=0.96, normals="smooth")
    return d


@document("games/bad_uv_index.dae", least=0.2)
def game_bad_uv(root):
    mesh = shapes.crate()
    picture(root, "games/textures/box.png", "planks")
    d = Document("own exporter", 1)
    d.image("box", "textures/box.png")
    d.look("wood", Look(diffuse="box"))
    d.look("metal", Look(diffuse=PAINT["metal"]))
    d.mesh("crate", mesh)
    text = d.libraries["geometries"]
    start = text.index("<p>") + 3
    end = text.index("</p>", start)
    values = text[start:end].split()
    for k in range(2, len(values), 9):
        values[k] = "99999"
    d.libraries["geometries"] = text[:start] + " ".join(values) + text[end:]
    d.add(d.node("n", f'<instance_geometry url="#crate">{d.bind(mesh.materials())}</instance_geometry>'))
    return d


# Maps, CAD, libraries -----------------------------------------------------------------------------------------------------------------


@document("gis/citygml_utm.dae")
def gis_utm(root):
    mesh = shapes.city(5, 6)
    d = Document("CityGML exporter", 1, version="1.4.0")
    d.palette(palette_of(mesh), ambient=(0.2, 0.2, 0.2))
    d.show("lod2", mesh, normals="none", uv=False, offset=(3459214.33, 5532871.81, 142.6))
    return d


@document("gis/utm_node.dae")
def gis_node(root):
    # The offset is the node's, and the parts have it too, the other way round.
    mesh = shapes.column_temple()
    d = Document("ArcGIS CityEngine 2014", 1, up="Y_UP")
    d.palette(palette_of(mesh))
    d.show("lot", mesh, translate(512344, 88, -4203377), offset=(-300, 0, 120))
    return d


@document("gis/google_earth/models/untitled.dae")
def gis_earth(root):
    mesh = shapes.tower(7)
    picture(root, "gis/google_earth/images/texture0.png", "brick")
    d = Document("Google SketchUp 6.0.515", 0.0254, "inch", version="1.4.1")
    d.image("material0", "../images/texture0.png")
    d.look(
        "wall",
        Look(
            diffuse="material0",
            model="phong",
            emission=BLACK,
            ambient=BLACK,
            specular=(0.33, 0.33, 0.33),
            shininess=0,
        ),
    )
    d.palette({m: PAINT[m] for m in mesh.materials() if m != "wall"}, model="phong", ambient=BLACK)
    d.show("mesh1", mesh, one_index=True)
    return d


@document("gis/terrain_flat.dae")
def gis_terrain(root):
    d = Document("QGIS plugin", 1)
    d.look("grass", Look(diffuse=(0.6, 0.6, 0.5), ambient=(0.6, 0.6, 0.5)))
    d.show(
        "dem",
        shapes.land(3000, 40, lambda x, y: 12 * math.sin(x * 0.004) * math.cos(y * 0.006), "grass"),
        normals="none",
        uv=False,
        offset=(370000, 5810000, 34),
    )
    return d


@document("cad/bracket_mm.dae")
def cad_bracket(root):
    mesh = shapes.prism([(0, 0), (80, 0), (80, 8), (8, 8), (8, 60), (0, 60)], 0, 40, 1, "metal").join(
        shapes.cylinder((60, 8, 20), (60, 14, 20), 10, 24, "metal")
    )
    d = Document("FreeCAD", 0.001, "millimeter")
    d.look(
        "metal",
        Look(
            diffuse=(0.8, 0.8, 0.8),
            model="phong",
            emission=BLACK,
            ambient=BLACK,
            specular=BLACK,
            shininess=0,
            transparent=WHITE,
            opaque="A_ONE",
            transparency=1,
        ),
    )
    d.show("bracket", mesh, scale=1, normals="none", uv=False, symbol=lambda m: "materialref")
    return d


@document("cad/bolts_nested_units.dae")
def cad_nested(root):
    # A library in inches inside a document in metres.
    d = Document("CAD exchange", 1, "meter", "Z_UP")
    mesh = shapes.bolt()
    d.palette(palette_of(mesh))
    d.put(
        "geometries",
        '<asset><created>2009-01-01T00:00:00Z</created><modified>2009-01-01T00:00:00Z</modified><unit name="inch" meter="0.0254"/><up_axis>Y_UP</up_axis></asset>',
    )
    d.mesh("bolt", mesh, up="Y_UP", scale=1)
    d.mesh("plate", shapes.block(0, 0, -0.15, 9, 6, 0.3, "metal"), up="Y_UP", scale=1)
    bind = d.bind(["metal"])
    for k in range(4):
        d.add(
            d.node(
                f"bolt{k}",
                f'<instance_geometry url="#bolt">{bind}</instance_geometry>',
                translate(0.07 * (k - 1.5), 0.04 * (k % 2), 0),
            )
        )
    d.add(d.node("plate-node", f'<instance_geometry url="#plate">{bind}</instance_geometry>'))
    return d


@document("cad/inverted.dae")
def cad_inverted(root):
    # Every face looks inwards.
    mesh = shapes.gear()
    mesh.faces = [(tuple(reversed(f)), m, tuple(reversed(uv))) for f, m, uv in mesh.faces]
    d = Document("STL converter", 1)
    d.palette(palette_of(mesh))
    d.show("gear", mesh)
    return d


@document("cad/zero_normals.dae")
def cad_zero_normals(root):
    mesh = shapes.robot_arm()
    d = Document("Rhinoceros 5.0", 0.001, "millimeter")
    d.palette(palette_of(mesh), ambient=BLACK)
    d.mesh("arm", mesh, normals="vertices", uv=False)
    text = d.libraries["geometries"]
    a = text.index("arm-normal-array")
    start, end = text.index(">", a) + 1, text.index("</float_array>", a)
    d.libraries["geometries"] = text[:start] + " ".join("0" for _ in text[start:end].split()) + text[end:]
    d.add(d.node("n", f'<instance_geometry url="#arm">{d.bind(mesh.materials())}</instance_geometry>'))
    return d


@document("cad/steps.dae")
def cad_instances(root):
    # 200 instances of one part, as a CAD assembly.
    d = Document("ANSYS SpaceClaim", 0.001, "millimeter")
    d.palette({"wood": PAINT["wood"], "metal": PAINT["metal"]})
    d.mesh("crate", shapes.crate())
    bind = d.bind(["wood", "metal"])
    for k in range(200):
        d.add(
            d.node(
                f"c{k}",
                f'<instance_geometry url="#crate">{bind}</instance_geometry>',
                translate(1100 * (k % 10), 1100 * (k // 10 % 5), 1050 * (k // 50)),
            )
        )
    return d


@document("cad/points_far_apart.dae")
def cad_stray(root):
    # A stray, unused vertex and a null node far from the part.
    mesh = shapes.car()
    mesh.points.append((90000.0, 4000.0, 0.0))
    d = Document("Carrara", 1, up="Y_UP")
    d.palette(palette_of(mesh))
    d.show("car", mesh)
    d.add(d.node("null", "", translate(5e6, 0, 0)))
    return d


# Odd ones -----------------------------------------------------------------------------------------------------------------------------


@document("odd/no_materials.dae")
def odd_bare(root):
    d = Document("own script", 1)
    d.mesh("m", shapes.chair(), normals="none", uv=False, symbol=None)
    d.add(d.node("n", '<instance_geometry url="#m"/>'))
    return d


@document("odd/white_on_white.dae")
def odd_white(root):
    mesh = shapes.city(4, 3)
    d = Document("own script", 1)
    for m in mesh.materials():
        d.look(
            m,
            Look(diffuse=WHITE, ambient=WHITE, emission=(0.1, 0.1, 0.1), model="phong", specular=WHITE, shininess=2),
        )
    d.show("m", mesh)
    return d


@document("odd/bright_lights.dae")
def odd_bright(root):
    # Four lights of 1 on a white thing: everything is over-exposed unless something is done.
    mesh = shapes.mug()
    d = Document("own script", 1)
    d.look("paint", Look(diffuse=(0.8, 0.8, 0.8), ambient=BLACK))
    d.show("m", mesh, normals="smooth")
    for k in range(4):
        d.light(f"l{k}", "point", (150, 150, 150), translate(0.5 * math.cos(1.57 * k), 0.5 * math.sin(1.57 * k), 0.5))
    return d


@document("odd/one_side_lit.dae")
def odd_one_side(root):
    d = Document("own script", 1)
    mesh = shapes.person(0.3)
    d.palette(palette_of(mesh))
    d.show("m", mesh, normals="smooth")
    d.light("key", "directional", WHITE, rotate("Z", 20) + rotate("X", 60))
    return d


@document("odd/ambient_only.dae")
def odd_ambient(root):
    mesh = shapes.sofa()
    d = Document("own script", 1, up="Y_UP")
    d.palette(palette_of(mesh), ambient=(0.2, 0.2, 0.2))
    d.show("m", mesh)
    d.light("a", "ambient", (0.4, 0.4, 0.4), "")
    return d


@document("odd/no_ids.dae")
def odd_no_ids(root):
    mesh = shapes.truck()
    d = Document("own script", 1, asset="<asset><created>2010-01-01</created><modified>2010-01-01</modified></asset>")
    d.palette(palette_of(mesh))
    d.show("m", mesh, up="Y_UP", kind="polylist")
    d.scene = d.scene.replace('<node id="m-node" name="m-node">', "<node>")
    return d


@document("odd/many_scenes.dae")
def odd_scenes(root):
    # Two visual scenes; the first is empty and <scene> names the second.
    mesh = shapes.dog()
    d = Document("own script", 1)
    d.palette(palette_of(mesh))
    d.put("visual_scenes", '<visual_scene id="Empty"><node id="nothing"/></visual_scene>\n')
    d.show("m", mesh, normals="smooth")
    return d


@document("odd/no_scene.dae")
def odd_no_scene(root):
    # No <scene>: what is meant is the only visual scene.
    class Bare(Document):
        def text(self, scene_id="Scene"):
            return super().text(scene_id).replace('<scene><instance_visual_scene url="#Scene"/></scene>\n', "")

    mesh = shapes.gear()
    d = Bare("own script", 1)
    d.palette(palette_of(mesh))
    d.show("m", mesh)
    return d


@document("odd/trifans.dae")
def odd_fans(root):
    mesh = shapes.gear()
    d = Document("own script", 1)
    d.palette(palette_of(mesh))
    d.show("m", mesh, kind="trifans", normals="none", uv=False)
    return d


@document("odd/external/assembly.dae")
def odd_external(root):
    # The geometry is in another document, in inches.
    mesh = shapes.chair()
    part = Document("own script", 0.0254, "inch")
    part.palette(palette_of(mesh))
    part.show("chair", mesh)
    part.write(root / "odd/external/parts.dae")
    d = Document("own script", 1)
    d.palette(palette_of(mesh))
    bind = d.bind(mesh.materials())
    for k in range(3):
        d.add(
            d.node(
                f"c{k}",
                f'<instance_geometry url="parts.dae#chair">{bind}</instance_geometry>',
                translate(0.8 * k, 0, 0),
            )
        )
    return d


@document("odd/empty_scene.dae", nothing=True)
def odd_empty(root):
    d = Document("own script", 1)
    d.add(d.node("n", ""))
    return d


@document("odd/library_only.dae", nothing=True)
def odd_library(root):
    # Geometry that no node instances, and no visual scene.
    mesh = shapes.chair()
    d = Document("own script", 1)
    d.palette(palette_of(mesh))
    d.mesh("m", mesh)
    d.scene = None
    return d


@document("odd/animation_only.dae", nothing=True)
def odd_animation(root):
    # A clip file of a game: joints and no skin.
    d = Document("3dsMax", 0.0254, "inch")
    d.add(
        '<node id="root" sid="root" type="JOINT"><node id="spine" sid="spine" type="JOINT"><translate>0 0 20</translate></node></node>\n'
    )
    return d


@document("odd/lights_and_cameras.dae", nothing=True)
def odd_lights(root):
    d = Document("Blender 2.8", 1)
    d.camera("Camera", translate(0, -5, 0) + rotate("X", 90))
    d.light("Light", "point", WHITE, translate(0, 0, 5))
    return d


@document("odd/empty_mesh.dae", nothing=True)
def odd_empty_mesh(root):
    d = Document("own script", 1)
    d.put(
        "geometries",
        '<geometry id="m"><mesh><source id="m-position"><float_array id="m-a" count="0"/><technique_common><accessor source="#m-a" count="0" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>'
        '<vertices id="m-v"><input semantic="POSITION" source="#m-position"/></vertices><triangles count="0"><input semantic="VERTEX" source="#m-v" offset="0"/><p/></triangles></mesh></geometry>\n',
    )
    d.add(d.node("n", '<instance_geometry url="#m"/>'))
    return d


@document("odd/constant_sign.dae")
def odd_constant(root):
    # Everything is <constant>: no light is needed.
    mesh = shapes.cone()
    d = Document("own script", 1)
    for m in mesh.materials():
        d.look(m, Look(model="constant", emission=PAINT[m]))
    d.show("m", mesh)
    return d


@document("odd/effect_missing.dae")
def odd_effect(root):
    # A material whose effect is nowhere.
    mesh = shapes.chair()
    d = Document("own script", 1)
    d.palette({"wood": PAINT["wood"]})
    d.put("materials", '<material id="cloth-material" name="cloth"><instance_effect url="#nowhere"/></material>\n')
    d.show("m", mesh)
    return d


@document("odd/count_wrong.dae")
def odd_count(root):
    # <triangles count> says one; <p> has all.
    mesh = shapes.mug()
    d = Document("own script", 1)
    d.palette(palette_of(mesh))
    d.mesh("m", mesh, normals="smooth")
    text = d.libraries["geometries"]
    a = text.index("<triangles count=")
    d.libraries["geometries"] = text[:a] + '<triangles count="1"' + text[text.index('"', a + 18) + 1 :]
    d.add(d.node("n", f'<instance_geometry url="#m">{d.bind(mesh.materials())}</instance_geometry>'))
    return d


@document("odd/morph_face.dae")
def odd_morph(root):
    base = shapes.ball(0, 0, 1.7, 0.12, 0.13, 0.16, 16, 12, "skin").join(
        shapes.ball(0, -0.13, 1.69, 0.02, 0.03, 0.03, 8, 6, "skin")
    )
    smile = base.moved(0, 0, 0)
    smile.points = [(p[0] * 1.15, p[1], p[2]) if p[2] < 1.66 else p for p in base.points]
    d = Document("Poser 8", 0.01, "centimeter", "Y_UP")
    d.palette(palette_of(base), ambient=BLACK)
    d.mesh("head", base, normals="smooth")
    d.mesh("smile", smile, normals="smooth")
    d.put(
        "controllers",
        '<controller id="face"><morph source="#head" method="NORMALIZED"><source id="face-t"><IDREF_array id="face-t-a" count="1">smile</IDREF_array><technique_common><accessor source="#face-t-a" count="1"><param name="MORPH_TARGET" type="IDREF"/></accessor></technique_common></source>'
        '<source id="face-w"><float_array id="face-w-a" count="1">0.5</float_array><technique_common><accessor source="#face-w-a" count="1"><param name="MORPH_WEIGHT" type="float"/></accessor></technique_common></source><targets><input semantic="MORPH_TARGET" source="#face-t"/><input semantic="MORPH_WEIGHT" source="#face-w"/></targets></morph></controller>\n',
    )
    d.add(d.node("n", f'<instance_controller url="#face">{d.bind(base.materials())}</instance_controller>'))
    return d


@document("max/tga/tank.dae")
def max_tga(root):
    mesh = shapes.truck()
    picture(root, "max/tga/Tank_D.tga", "livery")
    d = opencollada(mesh, {}, normals="smooth")
    d.image("tank", "file://D:\\art\\tank_d.TGA")
    for m in mesh.materials():
        d.look(
            m,
            Look(
                diffuse="tank" if m in ("cloth", "paint") else PAINT[m],
                model="blinn",
                ambient=GREY,
                specular=BLACK,
                shininess=10,
            ),
        )
    return d


@document("max/bmp/cottage.dae")
def max_bmp(root):
    mesh = shapes.house()
    picture(root, "max/bmp/texture/W\u00e4nde.bmp", "brick")
    d = opencollada(mesh, {})
    d.image("walls", "texture/W\u00e4nde.bmp")
    for m in mesh.materials():
        d.look(m, Look(diffuse="walls" if m == "wall" else PAINT[m], model="blinn", ambient=GREY))
    return d


@document("max/no_attenuation.dae")
def max_attenuation(root):
    # All three factors are 0: the light has no fall-off.
    mesh = shapes.sofa()
    d = opencollada(mesh, standard(mesh), normals="smooth")
    zero = "".join(f"<{k}_attenuation>0</{k}_attenuation>" for k in ("constant", "linear", "quadratic"))
    d.light("Omni01", "point", WHITE, translate(60, -120, 150), zero)
    d.light("Omni02", "point", WHITE, translate(-150, -60, 90), zero)
    return d


@document("max/black_lights.dae", told="--lights scene")
def max_black_lights(root):
    # The lights' colour is 0, their strength in an <extra> of another program.
    mesh = shapes.table()
    d = opencollada(mesh, standard(mesh))
    d.light("VRayLight01", "point", BLACK, translate(0, -90, 90), extra("VRAY", "<multiplier>30</multiplier>"))
    return d


@document("max/ambient_white.dae")
def max_ambient_white(root):
    mesh = shapes.column_temple()
    d = opencollada(
        mesh,
        {
            m: Look(diffuse=c, model="blinn", ambient=c, specular=BLACK, shininess=10)
            for m, c in palette_of(mesh).items()
        },
    )
    d.light("ambient", "ambient", WHITE, "")
    return d


@document("max/shininess_zero.dae")
def max_shininess(root):
    # FreeCAD and others: white, with a specular colour of 1 and an exponent of 0.
    mesh = shapes.gear()
    return opencollada(
        mesh,
        {
            m: Look(
                diffuse=WHITE,
                model="phong",
                emission=BLACK,
                ambient=BLACK,
                specular=WHITE,
                shininess=0,
                reflective=BLACK,
                reflectivity=0,
                transparent=BLACK,
                transparency=1,
            )
            for m in mesh.materials()
        },
    )


@document("max/box_bone.dae")
def max_idref(root):
    # Joints by id in an IDREF_array, and no <skeleton>.
    mesh = shapes.person(0.4)
    d = Document(OLD_MAX, 0.0254, "inch")
    for name, look in standard(mesh).items():
        d.look(name, look)
    d.skin("biped", mesh, PERSON, person_joint, [], ids=lambda n: f"Bip01_{n}-node", normals="smooth")
    text = d.libraries["controllers"]
    for name in PERSON:
        text = (
            text.replace(f" {name} ", f" Bip01_{name}-node ")
            .replace(f">{name} ", f">Bip01_{name}-node ")
            .replace(f" {name}<", f" Bip01_{name}-node<")
        )
    d.libraries["controllers"] = text.replace("Name_array", "IDREF_array").replace('type="Name"', 'type="IDREF"')
    return d


@document("max/bind_shape_scaled.dae")
def max_bind_shape(root):
    # The mesh is in metres, the joints in inches; the bind shape matrix is between them.
    mesh = shapes.dog()
    d = Document(MAX, 0.0254, "inch")
    for name, look in standard(mesh).items():
        d.look(name, look)
    s = 1 / 0.0254
    tree, instance = d.skin(
        "dog",
        mesh,
        DOG,
        dog_joint,
        ["root"],
        scene=False,
        normals="smooth",
        shape=(s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, 0, 0, 0, 1),
    )
    d.libraries["geometries"] = ""
    d.mesh("dog", mesh, scale=1, normals="smooth")
    d.add(tree + d.node("dog-node", instance))
    return d


@document("maya/ortho_camera.dae")
def maya_ortho(root):
    # Only the orthographic view "side" is exported; it is 30 m wide for a car of 4 m, and looks along the axis through it.
    mesh = shapes.chair()
    d = maya(mesh, four=False)
    d.camera(
        "side",
        translate(10000, 0, 0) + rotate("Y", 90),
        "<orthographic><xmag>1500</xmag><aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>100000</zfar></orthographic>",
    )
    return d


@document("maya/clipped_camera.dae")
def maya_clipped(root):
    # zfar of another unit lies before the model.
    mesh = shapes.house()
    d = maya(mesh, four=False)
    d.camera(
        "persp",
        translate(0, 400, 2600) + rotate("X", -6),
        "<perspective><xfov>54.4</xfov><aspect_ratio>1.5</aspect_ratio><znear>0.001</znear><zfar>100</zfar></perspective>",
    )
    return d


@document("maya/both_fov.dae")
def maya_both(root):
    mesh = shapes.car()
    d = maya(mesh, four=False, normals="smooth")
    d.camera(
        "persp",
        translate(700, 300, 700) + rotate("Y", 45) + rotate("X", -15),
        "<perspective><xfov>0</xfov><yfov>0</yfov><aspect_ratio>1.333</aspect_ratio><znear>1</znear><zfar>100000</zfar></perspective>",
    )
    return d


@document("maya/hidden_layer.dae")
def maya_mirrored(root):
    # The right half is an instance of the left with a scale of -1; a layer's node has a scale of 0.
    mesh = shapes.shelf()
    d = maya(mesh, four=False)
    d.add(
        d.node(
            "mirror",
            f'<instance_geometry url="#polySurface1">{d.bind(mesh.materials())}</instance_geometry>',
            translate(220, 0, 0) + "<scale>-1 1 1</scale>",
        )
    )
    d.add(
        d.node(
            "unused",
            f'<instance_geometry url="#polySurface1">{d.bind(mesh.materials())}</instance_geometry>',
            "<scale>0 0 0</scale>",
        )
    )
    return d


@document("sketchup/kmz/castle.kmz")
def sk_kmz(root):
    picture(root, "sketchup/kmz_parts/images/texture0.png", "brick")
    d = Document("Google SketchUp 6.0.1099", 0.0254, "inch")
    mesh = shapes.column_temple()
    d.image("material0", "../images/texture0.png")
    d.look("wall", Look(diffuse="material0"))
    d.look("roof", Look(diffuse=PAINT["roof"]))
    d.show("mesh1", mesh, one_index=True, both=True)
    kml = '<?xml version="1.0"?><kml xmlns="http://earth.google.com/kml/2.1"><Placemark><Model><Link><href>models/castle.dae</href></Link></Model></Placemark></kml>'
    return Archive(
        d,
        {"doc.kml": kml},
        "models/castle.dae",
        {"images/texture0.png": root / "sketchup/kmz_parts/images/texture0.png"},
    )


@document("sketchup/zae/fence.zae")
def sk_zae(root):
    picture(root, "sketchup/kmz_parts/images/planks.png", "planks")
    d = Document("Trimble SketchUp 2013", 0.0254, "inch")
    d.image("planks", "images/planks.png")
    d.look("wood", Look(diffuse="planks"))
    d.show("fence", shapes.crate().named("wood").join(shapes.fence().moved(-2, 1.2)), one_index=True)
    manifest = '<?xml version="1.0"?><dae_root>fence.dae</dae_root>'
    return Archive(
        d,
        {"manifest.xml": manifest},
        "fence.dae",
        {"images/planks.png": root / "sketchup/kmz_parts/images/planks.png"},
    )


class Archive:
    """A document with what belongs to it in a zip file."""

    def __init__(self, document, texts, place, files):
        self.document, self.texts, self.place, self.files = document, texts, place, files

    def write(self, path):
        path.parent.mkdir(parents=True, exist_ok=True)
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, text in {**self.texts, self.place: self.document.text()}.items():
                archive.writestr(name, text)
            for name, file in self.files.items():
                archive.write(file, name)


@document("sketchup/wall_with_holes.dae")
def sk_holes(root):
    # A wall as <polygons> with <ph>: windows are holes.
    d = Document("Bentley MicroStation", 1, version="1.4.1")
    d.look("wall", Look(diffuse=PAINT["wall"]))
    corners = [(0, 0), (9, 0), (9, 4), (0, 4)] + [
        (x + dx, 1.2 + dz) for x in (1, 4, 7) for dx, dz in ((0, 0), (0, 1.4), (1.2, 1.4), (1.2, 0))
    ]
    points = [(x, y, z) for y in (0, 0.3) for x, z in corners]
    n = len(corners)
    holes = "".join(f"<h>{' '.join(map(str, range(4 + 4 * k, 8 + 4 * k)))}</h>" for k in range(3))
    back = "".join(f"<h>{' '.join(str(n + i) for i in reversed(range(4 + 4 * k, 8 + 4 * k)))}</h>" for k in range(3))
    sides = [(0, 1, n + 1, n), (1, 2, n + 2, n + 1), (2, 3, n + 3, n + 2), (3, 0, n, n + 3)] + [
        (4 + 4 * k + i, 4 + 4 * k + (i + 1) % 4, n + 4 + 4 * k + (i + 1) % 4, n + 4 + 4 * k + i)
        for k in range(3)
        for i in range(4)
    ]
    body = f"<ph><p>0 1 2 3</p>{holes}</ph><ph><p>{n + 3} {n + 2} {n + 1} {n}</p>{back}</ph>"
    d.put(
        "geometries",
        '<geometry id="w"><mesh>'
        + source("w-p", points, "XYZ")
        + '<vertices id="w-v"><input semantic="POSITION" source="#w-p"/></vertices>'
        f'<polygons count="{2 + len(sides)}" material="wall"><input semantic="VERTEX" source="#w-v" offset="0"/>'
        + "".join(f"<p>{' '.join(map(str, s))}</p>" for s in sides)
        + body
        + "</polygons></mesh></geometry>\n",
    )
    d.add(d.node("n", f'<instance_geometry url="#w">{d.bind(["wall"])}</instance_geometry>'))
    return d


@document("blender/ortho_top.dae")
def blender_ortho(root):
    d = blender(shapes.house(), camera=False)
    d.camera(
        "Top",
        translate(0, 0, 40),
        "<orthographic><xmag>14</xmag><aspect_ratio>1.777778</aspect_ratio><znear>0.1</znear><zfar>100</zfar></orthographic>",
    )
    return d


@document("blender/hemi_two_lamps.dae")
def blender_two(root):
    d = blender(shapes.person(0.5), energy=1, camera=False, normals="smooth")
    d.light("Hemi", "ambient", (0.3, 0.3, 0.3), translate(0, 0, 8))
    return d


@document("blender/vertex_paint.dae")
def blender_paint(root):
    mesh = shapes.dog()
    return blender(
        mesh,
        camera=False,
        looks={m: Look(diffuse=(0.64, 0.64, 0.64), model="phong", ambient=BLACK) for m in mesh.materials()},
        colours=lambda p: (0.9, 0.5 + 0.4 * p[1], 0.3),
        normals="smooth",
    )


@document("urdf/half_transparent/cover.dae")
def urdf_half(root):
    # Alpha of the diffuse colour 0 (some exporters leave it out): it is no transparency.
    mesh = shapes.rover()
    return link(
        mesh,
        looks={
            m: Look(diffuse=(*c, 0), ambient=(*c, 0), model="phong", specular=(0, 0, 0, 0), shininess=1)
            for m, c in palette_of(mesh).items()
        },
        normals="smooth",
    )


@document("games/dds/helmet.dae", missing=True)
def game_dds(root):
    # Only a .psd was named, and nobody has it.
    mesh = shapes.person(0.1)
    d = Document("Modo 401", 1, up="Y_UP")
    d.image("helmet", "file:///Q:/art/helmet.psd")
    d.look("skin", Look(diffuse="helmet"))
    d.palette({m: PAINT[m] for m in mesh.materials() if m != "skin"})
    d.show("helmet", mesh, normals="smooth")
    return d


def write(root):
    """Writes all documents; path -> expectations."""
    root = Path(root)
    expected = {}
    for path, function, wanted in CORPUS:
        function(root).write(root / path)
        expected[path] = wanted
    (root / "corpus.json").write_text(json.dumps(expected, indent=1) + "\n")
    return expected


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[0])
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    print(f"{len(write(sys.argv[1]))} documents")
