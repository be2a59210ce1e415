#!/usr/bin/env python3
"""Wrote the ten blind documents of this folder (see README.md): write.py [FOLDER]."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import shapes  # noqa: E402

OUT = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))


def num(v, digits=6):
    s = f"{v:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if s in ("-0", "") else s


def nums(values, digits=6):
    return " ".join(num(v, digits) for v in values)


def save(name, text):
    path = os.path.join(OUT, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as f:
        f.write(text)


def picture(name, pixel, size=64, channels=3):
    path = os.path.join(OUT, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    shapes.png(path, size, size, pixel, channels)


def y_up(p):
    return (p[0], p[2], -p[1])


def floats(ident, rows, params):
    flat = [c for row in rows for c in row]
    accessor = "".join(f'<param name="{p}" type="float"/>' for p in params)
    return (
        f'<source id="{ident}">\n<float_array id="{ident}-array" count="{len(flat)}">{nums(flat)}</float_array>\n<technique_common>'
        f'<accessor source="#{ident}-array" count="{len(rows)}" stride="{len(params)}">{accessor}</accessor></technique_common>\n</source>\n'
    )


def triangles_of(mesh):
    for face, material, uv in mesh.faces:
        for k in range(1, len(face) - 1):
            yield (face[0], face[k], face[k + 1]), material, (uv[0], uv[k], uv[k + 1])


def geometry(ident, mesh, place, scale, kind="triangles", normals="flat", uvs=True, symbol=str, name=None):
    """<geometry>: positions placed and scaled, normals flat, smooth or none, one primitive a material."""
    points = [tuple(c * scale for c in place(p)) for p in mesh.points]
    sources = floats(f"{ident}-positions", points, "XYZ")
    rows, table = [], {}

    def row(value):
        key = tuple(round(c, 5) for c in value)
        if key not in table:
            table[key] = len(rows)
            rows.append(key)
        return table[key]

    smooth = mesh.smooth_normals() if normals == "smooth" else None
    uv_rows, uv_table = [], {}

    def uv_row(value):
        key = tuple(round(c, 4) for c in value)
        if key not in uv_table:
            uv_table[key] = len(uv_rows)
            uv_rows.append(key)
        return uv_table[key]

    faces = list(triangles_of(mesh)) if kind == "triangles" else mesh.faces
    by_material = {}
    for face, material, uv in faces:
        corners = []
        n = shapes.unit(mesh.face_normal(tuple(face)))
        for k, corner in enumerate(face):
            item = [corner]
            if normals != "none":
                item.append(row(place(smooth[corner] if smooth else n)))
            if uvs:
                item.append(uv_row(uv[k]))
            corners.append(item)
        by_material.setdefault(material, []).append(corners)
    if normals != "none":
        sources += floats(f"{ident}-normals", rows, "XYZ")
    if uvs:
        sources += floats(f"{ident}-map1", uv_rows, "ST")
    prims = ""
    for material, polys in by_material.items():
        inputs, offset = f'<input semantic="VERTEX" source="#{ident}-vertices" offset="0"/>', 1
        if normals != "none":
            inputs += f'<input semantic="NORMAL" source="#{ident}-normals" offset="{offset}"/>'
            offset += 1
        if uvs:
            inputs += f'<input semantic="TEXCOORD" source="#{ident}-map1" offset="{offset}" set="0"/>'
        head = f'count="{len(polys)}" material="{symbol(material)}"'
        lists = [" ".join(str(i) for c in poly for i in c) for poly in polys]
        if kind == "triangles":
            prims += f"<triangles {head}>{inputs}<p>{' '.join(lists)}</p></triangles>\n"
        elif kind == "polylist":
            prims += f"<polylist {head}>{inputs}<vcount>{' '.join(str(len(p)) for p in polys)}</vcount><p>{' '.join(lists)}</p></polylist>\n"
        else:
            prims += f"<polygons {head}>{inputs}" + "".join(f"<p>{p}</p>" for p in lists) + "</polygons>\n"
    return (
        f'<geometry id="{ident}" name="{name or ident}">\n<mesh>\n{sources}<vertices id="{ident}-vertices"><input semantic="POSITION" '
        f'source="#{ident}-positions"/></vertices>\n{prims}</mesh>\n</geometry>\n'
    )


def head(tool, unit_name, meter, up, version="1.4.1", author=""):
    space = {
        "1.4.1": "http://www.collada.org/2005/11/COLLADASchema",
        "1.4.0": "http://www.collada.org/2005/11/COLLADASchema",
        "1.5.0": "http://www.collada.org/2008/03/COLLADASchema",
    }[version]
    return (
        f'<?xml version="1.0" encoding="utf-8"?>\n<COLLADA xmlns="{space}" version="{version}">\n<asset>\n<contributor>{author}<authoring_tool>{tool}'
        f"</authoring_tool></contributor>\n<created>2009-03-14T10:12:05Z</created>\n<modified>2009-03-14T10:12:05Z</modified>\n"
        f'<unit meter="{meter}" name="{unit_name}"/>\n<up_axis>{up}</up_axis>\n</asset>\n'
    )


def color(name, rgb, a=1):
    return f"<{name}><color>{nums(rgb)} {num(a)}</color></{name}>"


# 1. Gazebo ----------------------------------------------------------------------------------------------------------------------------


def cafe_table():
    mesh = shapes.table(round_top=True).join(shapes.mug().moved(0.15, -0.1, 0.76).named({"paint": "metal"}))
    picture("gazebo/cafe_table/materials/textures/Maple.png", shapes.planks)
    picture("gazebo/cafe_table/materials/textures/Aluminum.png", shapes.steel)
    t = head("Blender v:249 - Illusoft Collada Exporter v:0.3.162", "centimeter", "0.01", "Z_UP")
    t += '<library_images>\n<image id="Maple_png" name="Maple_png"><init_from>../materials/textures/Maple.png</init_from></image>\n'
    t += '<image id="Aluminum_png" name="Aluminum_png"><init_from>../materials/textures/Aluminum.png</init_from></image>\n</library_images>\n'
    t += "<library_materials>\n"
    for m in ("wood", "metal"):
        t += f'<material id="Mat_{m}" name="Mat_{m}"><instance_effect url="#Mat_{m}-fx"/></material>\n'
    t += "</library_materials>\n<library_effects>\n"
    for m, image in (("wood", "Maple_png"), ("metal", "Aluminum_png")):
        t += f'<effect id="Mat_{m}-fx" name="Mat_{m}-fx"><profile_COMMON>\n<newparam sid="{image}-surface"><surface type="2D"><init_from>{image}</init_from><format>A8R8G8B8</format></surface></newparam>\n'
        t += f'<newparam sid="{image}-sampler"><sampler2D><source>{image}-surface</source><minfilter>LINEAR_MIPMAP_LINEAR</minfilter><magfilter>LINEAR</magfilter></sampler2D></newparam>\n'
        t += f'<technique sid="blender"><phong>{color("emission", (0, 0, 0))}{color("ambient", (0.5, 0.5, 0.5))}<diffuse><texture texture="{image}-sampler" texcoord="CHANNEL1"/></diffuse>{color("specular", (0.5, 0.5, 0.5))}'
        t += f'<shininess><float>12.5</float></shininess>{color("reflective", (1, 1, 1))}<reflectivity><float>0</float></reflectivity>{color("transparent", (1, 1, 1))}<transparency><float>0</float></transparency></phong>'
        t += '<extra><technique profile="GOOGLEEARTH"><double_sided>1</double_sided></technique></extra></technique></profile_COMMON></effect>\n'
    t += '</library_effects>\n<library_lights>\n<light id="Spot" name="Spot"><technique_common><point><color>1 1 1</color><constant_attenuation>1</constant_attenuation>'
    t += "<linear_attenuation>0</linear_attenuation><quadratic_attenuation>0.000556</quadratic_attenuation></point></technique_common></light>\n</library_lights>\n"
    t += (
        "<library_geometries>\n"
        + geometry("Table_001", mesh, lambda p: p, 100, "polygons", "flat", True, lambda m: f"Mat_{m}").replace(
            'name="Table_001"', 'name="Table_001"'
        )
        + "</library_geometries>\n"
    )
    binds = "".join(
        f'<instance_material symbol="Mat_{m}" target="#Mat_{m}"><bind_vertex_input semantic="CHANNEL1" input_semantic="TEXCOORD" input_set="0"/></instance_material>'
        for m in ("wood", "metal")
    )
    t += '<library_visual_scenes><visual_scene id="Scene" name="Scene">\n<node layer="L1" id="Lamp" name="Lamp"><translate sid="translate">40.7 10.0 -590.3</translate><rotate sid="rotateZ">0 0 1 106.9</rotate><scale sid="scale">1 1 1</scale><instance_light url="#Spot"/></node>\n'
    t += f'<node layer="L1" id="Table" name="Table"><translate sid="translate">0 0 0</translate><rotate sid="rotateZ">0 0 1 0</rotate><rotate sid="rotateY">0 1 0 0</rotate><rotate sid="rotateX">1 0 0 0</rotate><scale sid="scale">1 1 1</scale>'
    t += f'<instance_geometry url="#Table_001"><bind_material><technique_common>{binds}</technique_common></bind_material></instance_geometry></node>\n</visual_scene></library_visual_scenes>\n'
    t += '<library_physics_materials><physics_material id="Table-PhysicsMaterial" name="Table-PhysicsMaterial"><technique_common><dynamic_friction>0.5</dynamic_friction><restitution>0</restitution><static_friction>0.5</static_friction></technique_common></physics_material></library_physics_materials>\n'
    save(
        "gazebo/cafe_table/meshes/cafe_table.dae",
        t + '<scene><instance_visual_scene url="#Scene"/></scene>\n</COLLADA>\n',
    )


# 2. SketchUp --------------------------------------------------------------------------------------------------------------------------


def house_sketchup():
    mesh = shapes.house()
    picture("house_sketchup/Brick_Antique.png", shapes.brick)
    picture("house_sketchup/Vegetation_Grass1.png", shapes.grass)
    t = head("Google SketchUp 8.0.14346", "inch", "0.02539999969185352", "Z_UP")
    order = list(mesh.split().items())
    t += '<library_visual_scenes>\n<visual_scene id="ID1">\n<node name="SketchUp">\n<node id="ID2" name="House">\n<matrix>1 0 0 311.0236 0 1 0 157.4803 0 0 1 0 0 0 0 1</matrix>\n<instance_node url="#ID3"/>\n</node>\n'
    t += '<node name="skp_camera_Last_Saved_SketchUp_View"><matrix>0.8137 0.2417 -0.5287 -310.2 -0.5813 0.3384 -0.74 -565.1 0 0.9095 0.4158 472.4 0 0 0 1</matrix><instance_camera url="#ID40"/></node>\n</node>\n</visual_scene>\n</library_visual_scenes>\n'
    t += '<library_nodes>\n<node id="ID3" name="House">\n'
    for k, (name, _) in enumerate(order):
        t += f'<instance_geometry url="#G{k}"><bind_material><technique_common><instance_material symbol="Material2" target="#M_{name}"><bind_vertex_input semantic="UVSET0" input_semantic="TEXCOORD" input_set="0"/></instance_material></technique_common></bind_material></instance_geometry>\n'
    t += '<instance_geometry url="#Edges"><bind_material><technique_common><instance_material symbol="Material2" target="#M_edge"/></technique_common></bind_material></instance_geometry>\n</node>\n</library_nodes>\n<library_geometries>\n'
    for k, (name, part) in enumerate(order):
        both = shapes.Mesh().join(part)
        both.faces = both.faces + [(tuple(reversed(f)), m, tuple(reversed(uv))) for f, m, uv in both.faces]
        # SketchUp writes one row of position, normal and texture coordinate a corner, all read through VERTEX
        points, normals, uvs, index = [], [], [], []
        table = {}
        for face, _, uv in triangles_of(both):
            n = shapes.unit(part.face_normal(tuple(face)))
            for c, w in zip(face, uv):
                key = (c, tuple(round(x, 4) for x in n), w)
                if key not in table:
                    table[key] = len(points)
                    points.append(tuple(x / 0.0254 for x in both.points[c]))
                    normals.append(n)
                    uvs.append(w)
                index.append(table[key])
        t += (
            f'<geometry id="G{k}">\n<mesh>\n'
            + floats(f"G{k}P", points, "XYZ")
            + floats(f"G{k}N", normals, "XYZ")
            + floats(f"G{k}T", uvs, "ST")
        )
        t += f'<vertices id="G{k}V"><input semantic="POSITION" source="#G{k}P"/><input semantic="NORMAL" source="#G{k}N"/></vertices>\n'
        t += (
            f'<triangles count="{len(index) // 3}" material="Material2"><input offset="0" semantic="VERTEX" source="#G{k}V"/><input offset="1" semantic="TEXCOORD" source="#G{k}T"/><p>'
            + " ".join(f"{i} {i}" for i in index)
            + "</p></triangles>\n</mesh>\n</geometry>\n"
        )
    edges, points = set(), [tuple(x / 0.0254 for x in p) for p in mesh.points]
    for face, _, _ in mesh.faces:
        for a, b in zip(face, face[1:] + face[:1]):
            edges.add((min(a, b), max(a, b)))
    t += (
        '<geometry id="Edges"><mesh>\n'
        + floats("EdgesP", points, "XYZ")
        + '<vertices id="EdgesV"><input semantic="POSITION" source="#EdgesP"/></vertices>\n'
    )
    t += (
        f'<lines count="{len(edges)}" material="Material2"><input offset="0" semantic="VERTEX" source="#EdgesV"/><p>'
        + " ".join(f"{a} {b}" for a, b in sorted(edges))
        + "</p></lines>\n</mesh></geometry>\n</library_geometries>\n<library_materials>\n"
    )
    looks = {
        "wall": "Brick_Antique",
        "grass": "Vegetation_Grass1",
        "roof": (0.5451, 0.2706, 0.0745),
        "wood": (0.6275, 0.3216, 0.1765),
        "glass": (0.2824, 0.4627, 0.6),
        "edge": (0, 0, 0),
    }
    for name in looks:
        t += f'<material id="M_{name}" name="{name}"><instance_effect url="#E_{name}"/></material>\n'
    t += "</library_materials>\n<library_effects>\n"
    for name, look in looks.items():
        t += f'<effect id="E_{name}"><profile_COMMON>'
        if isinstance(look, str):
            t += f'<newparam sid="S_{name}"><surface type="2D"><init_from>I_{name}</init_from></surface></newparam><newparam sid="T_{name}"><sampler2D><source>S_{name}</source></sampler2D></newparam>'
            t += f'<technique sid="COMMON"><lambert><diffuse><texture texture="T_{name}" texcoord="UVSET0"/></diffuse></lambert></technique>'
        elif name == "glass":
            t += f'<technique sid="COMMON"><lambert>{color("diffuse", look)}<transparent opaque="A_ONE"><color>1 1 1 1</color></transparent><transparency><float>0.5</float></transparency></lambert></technique>'
        elif name == "edge":
            t += f'<technique sid="COMMON"><constant><transparent opaque="A_ONE"><color>{nums(look)} 1</color></transparent><transparency><float>1</float></transparency></constant></technique>'
        else:
            t += f'<technique sid="COMMON"><lambert>{color("diffuse", look)}</lambert></technique>'
        t += "</profile_COMMON></effect>\n"
    t += '</library_effects>\n<library_cameras><camera id="ID40" name="skp_camera_Last_Saved_SketchUp_View"><optics><technique_common><perspective><yfov>35</yfov><aspect_ratio>0</aspect_ratio><znear>1</znear><zfar>1000</zfar></perspective></technique_common></optics></camera></library_cameras>\n'
    t += '<library_images>\n<image id="I_wall"><init_from>house_sketchup/Brick_Antique.png</init_from></image>\n<image id="I_grass"><init_from>house_sketchup/Vegetation_Grass1.png</init_from></image>\n</library_images>\n'
    save("house_sketchup.dae", t + '<scene><instance_visual_scene url="#ID1"/></scene>\n</COLLADA>\n')


# 3. 3ds Max ---------------------------------------------------------------------------------------------------------------------------


def hatchback_max():
    mesh = shapes.car()
    picture("hatch_body.png", shapes.livery)
    t = head(
        "OpenCOLLADA for 3ds Max;  Version: 1.3.1;  Revision: 850M;  Platform: Win32;  Configuration: Release Max2010",
        "inch",
        "0.0254",
        "Z_UP",
        "1.4.1",
        "<author>artist</author>",
    )
    looks = {
        "paint": (0.588, 0.588, 0.588),
        "glass": (0.1, 0.15, 0.2),
        "rubber": (0.02, 0.02, 0.02),
        "metal": (0.7, 0.7, 0.7),
        "glow": (1, 1, 0.8),
        "red": (0.8, 0.05, 0.05),
    }
    t += "<library_effects>\n"
    for name, rgb in looks.items():
        diffuse = color("diffuse", rgb)
        params = ""
        if name == "paint":
            params = '<newparam sid="hatch_body_png-surface"><surface type="2D"><init_from>hatch_body_png</init_from></surface></newparam><newparam sid="hatch_body_png-sampler"><sampler2D><source>hatch_body_png-surface</source></sampler2D></newparam>'
            diffuse = '<diffuse><texture texture="hatch_body_png-sampler" texcoord="CHANNEL1"/></diffuse>'
        t += f'<effect id="{name}"><profile_COMMON>{params}<technique sid="common"><blinn>{color("emission", rgb if name == "glow" else (0, 0, 0))}{color("ambient", (0.588, 0.588, 0.588))}{diffuse}{color("specular", (0, 0, 0))}<shininess><float>10</float></shininess>'
        t += (
            '<reflective><color>0 0 0 1</color></reflective><transparent opaque="A_ONE"><color>1 1 1 1</color></transparent><transparency><float>'
            + ("0.4" if name == "glass" else "1")
            + "</float></transparency></blinn></technique></profile_COMMON>"
        )
        t += '<extra><technique profile="OpenCOLLADA3dsMax"><extended_shader><apply_reflection_dimming>0</apply_reflection_dimming><opacity_type sid="opacity_type">0</opacity_type><reflection_level>3</reflection_level></extended_shader></technique></extra></effect>\n'
    t += "</library_effects>\n<library_materials>\n" + "".join(
        f'<material id="{m}-material" name="{m}"><instance_effect url="#{m}"/></material>\n' for m in looks
    )
    t += (
        "</library_materials>\n<library_geometries>\n"
        + geometry("geom-hatchback", mesh, lambda p: p, 1 / 0.0254, "triangles", "smooth", True, str, "hatchback")
        + "</library_geometries>\n"
    )
    t += '<library_images><image id="hatch_body_png"><init_from>file:///C:/Documents%20and%20Settings/artist/My%20Documents/3dsmax/maps/hatch_body.png</init_from></image></library_images>\n'
    binds = "".join(
        f'<instance_material symbol="{m}" target="#{m}-material"><bind_vertex_input semantic="CHANNEL1" input_semantic="TEXCOORD" input_set="0"/></instance_material>'
        for m in looks
    )
    t += '<library_visual_scenes><visual_scene id="MaxScene">\n<node id="node-hatchback" name="hatchback"><matrix>1 0 0 -15.2 0 1 0 3.1 0 0 1 0 0 0 0 1</matrix>\n<node><matrix>1 0 0 0 0 1 0 0 0 0 1 1.25 0 0 0 1</matrix>'
    t += f'<instance_geometry url="#geom-hatchback"><bind_material><technique_common>{binds}</technique_common></bind_material></instance_geometry></node>\n<extra><technique profile="OpenCOLLADA"><cast_shadows sid="cast_shadows">1</cast_shadows></technique></extra></node>\n'
    t += '<extra><technique profile="MAX3D"><frame_rate>30</frame_rate></technique></extra></visual_scene></library_visual_scenes>\n'
    save("hatchback_max.dae", t + '<scene><instance_visual_scene url="#MaxScene"/></scene>\n</COLLADA>\n')


# 4. Maya ------------------------------------------------------------------------------------------------------------------------------


def officer_maya():
    mesh = shapes.person(1.3)
    looks = {
        "cloth": (0.1, 0.12, 0.35),
        "skin": (0.85, 0.62, 0.5),
        "hair": (0.12, 0.07, 0.03),
        "trousers": (0.08, 0.08, 0.15),
        "shoes": (0.05, 0.05, 0.05),
    }
    t = head("Maya 2008 | ColladaMaya v3.05B", "centimeter", "0.01", "Y_UP", "1.4.1", "<author>rigger</author>")
    t += (
        "<library_cameras>\n"
        + "".join(
            f'<camera id="{c}Shape" name="{c}Shape"><optics><technique_common>'
            + (
                "<perspective><yfov>37.8493</yfov><aspect_ratio>1.5</aspect_ratio><znear>10</znear><zfar>100000</zfar></perspective>"
                if c == "persp"
                else "<orthographic><xmag>3000</xmag><ymag>3000</ymag><znear>0.1</znear><zfar>10000</zfar></orthographic>"
            )
            + "</technique_common></optics></camera>\n"
            for c in ("persp", "top", "front", "side")
        )
        + "</library_cameras>\n<library_materials>\n"
    )
    t += (
        "".join(
            f'<material id="{m}SG_material" name="{m}"><instance_effect url="#{m}_fx"/></material>\n' for m in looks
        )
        + "</library_materials>\n<library_effects>\n"
    )
    for name, rgb in looks.items():
        t += f'<effect id="{name}_fx"><profile_COMMON><technique sid="common"><phong>{color("emission", (0, 0, 0))}{color("ambient", (0, 0, 0))}{color("diffuse", rgb)}{color("specular", (0.2, 0.2, 0.2))}<shininess><float>20</float></shininess>{color("reflective", (0, 0, 0))}<reflectivity><float>0.5</float></reflectivity>'
        t += '<transparent opaque="RGB_ZERO"><color>0 0 0 1</color></transparent><transparency><float>1</float></transparency></phong></technique></profile_COMMON></effect>\n'
    t += (
        "</library_effects>\n<library_geometries>\n"
        + geometry("bodyShape", mesh, y_up, 100, "polylist", "smooth", True, lambda m: f"{m}SG")
        + "</library_geometries>\n"
    )
    joints = {
        "hips": (None, (0, 0, 0.95)),
        "spine": ("hips", (0, 0, 1.2)),
        "head": ("spine", (0, 0, 1.52)),
        "armL": ("spine", (-0.2, 0, 1.42)),
        "armR": ("spine", (0.2, 0, 1.42)),
        "legL": ("hips", (-0.09, 0, 0.92)),
        "legR": ("hips", (0.09, 0, 0.92)),
    }
    names = list(joints)

    def joint_of(p):
        if p[2] > 1.5:
            return "head"
        if abs(p[0]) > 0.2 and p[2] > 1.0:
            return "armL" if p[0] < 0 else "armR"
        if p[2] < 0.92:
            return "legL" if p[0] < 0 else "legR"
        return "spine" if p[2] > 1.15 else "hips"

    inverse = []
    for n in names:
        x, y, z = (100 * c for c in y_up(joints[n][1]))
        inverse.append((1, 0, 0, -x, 0, 1, 0, -y, 0, 0, 1, -z, 0, 0, 0, 1))
    flat = " ".join(nums(m) for m in inverse)
    t += '<library_controllers><controller id="bodyController"><skin source="#bodyShape"><bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>\n'
    t += f'<source id="bodyJoints"><Name_array id="bodyJoints-array" count="{len(names)}">{" ".join(names)}</Name_array><technique_common><accessor source="#bodyJoints-array" count="{len(names)}"><param name="JOINT" type="Name"/></accessor></technique_common></source>\n'
    t += f'<source id="bodyBinds"><float_array id="bodyBinds-array" count="{16 * len(names)}">{flat}</float_array><technique_common><accessor source="#bodyBinds-array" count="{len(names)}" stride="16"><param type="float4x4"/></accessor></technique_common></source>\n'
    t += '<source id="bodyWeights"><float_array id="bodyWeights-array" count="1">1</float_array><technique_common><accessor source="#bodyWeights-array" count="1"><param type="float"/></accessor></technique_common></source>\n'
    t += '<joints><input semantic="JOINT" source="#bodyJoints"/><input semantic="INV_BIND_MATRIX" source="#bodyBinds"/></joints>\n'
    t += f'<vertex_weights count="{len(mesh.points)}"><input semantic="JOINT" offset="0" source="#bodyJoints"/><input semantic="WEIGHT" offset="1" source="#bodyWeights"/><vcount>{" ".join("1" for _ in mesh.points)}</vcount><v>{" ".join(f"{names.index(joint_of(p))} 0" for p in mesh.points)}</v></vertex_weights></skin></controller></library_controllers>\n'
    t += '<library_animations><animation id="armR-anim"><animation>'
    times, angles = [0, 0.5, 1.0, 1.5, 2.0], [0, -25, -50, -25, 0]
    t += floats("armR_rotateZ-in", [(v,) for v in times], ["TIME"]) + floats(
        "armR_rotateZ-out", [(v,) for v in angles], ["ANGLE"]
    )
    t += '<source id="armR_rotateZ-int"><Name_array id="armR_rotateZ-int-array" count="5">LINEAR LINEAR LINEAR LINEAR LINEAR</Name_array><technique_common><accessor source="#armR_rotateZ-int-array" count="5"><param name="INTERPOLATION" type="Name"/></accessor></technique_common></source>'
    t += '<sampler id="armR_rotateZ"><input semantic="INPUT" source="#armR_rotateZ-in"/><input semantic="OUTPUT" source="#armR_rotateZ-out"/><input semantic="INTERPOLATION" source="#armR_rotateZ-int"/></sampler><channel source="#armR_rotateZ" target="armR/rotateZ.ANGLE"/></animation></animation></library_animations>\n'

    def joint(n):
        parent, at = joints[n]
        origin = joints[parent][1] if parent else (0, 0, 0)
        move = nums(100 * c for c in y_up(tuple(a - b for a, b in zip(at, origin))))
        inner = "".join(joint(k) for k in names if joints[k][0] == n)
        return f'<node id="{n}" name="{n}" sid="{n}" type="JOINT"><translate sid="translate">{move}</translate><rotate sid="rotateZ">0 0 1 0</rotate><rotate sid="rotateY">0 1 0 0</rotate><rotate sid="rotateX">1 0 0 0</rotate>{inner}</node>\n'

    binds = "".join(f'<instance_material symbol="{m}SG" target="#{m}SG_material"/>' for m in looks)
    t += '<library_visual_scenes><visual_scene id="VisualSceneNode" name="officer">\n'
    for c, where in (
        ("persp", "2800 2100 2800"),
        ("top", "0 10000.1 0"),
        ("front", "0 0 10000.1"),
        ("side", "10000.1 0 0"),
    ):
        turn = {"persp": "-27.938", "top": "-90"}.get(c, "0")
        yaw = {"persp": "45", "side": "90"}.get(c, "0")
        t += f'<node id="{c}" name="{c}"><translate sid="translate">{where}</translate><rotate sid="rotateY">0 1 0 {yaw}</rotate><rotate sid="rotateX">1 0 0 {turn}</rotate><instance_camera url="#{c}Shape"/><extra><technique profile="MAYA"><dynamic_attributes/></technique><technique profile="FCOLLADA"><visibility>0</visibility></technique></extra></node>\n'
    t += (
        joint("hips")
        + f'<node id="body" name="body"><instance_controller url="#bodyController"><skeleton>#hips</skeleton><bind_material><technique_common>{binds}</technique_common></bind_material></instance_controller></node>\n'
    )
    save(
        "officer_maya.dae",
        t
        + '</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene url="#VisualSceneNode"/></scene>\n</COLLADA>\n',
    )


# 5. a robot's link --------------------------------------------------------------------------------------------------------------------


def forearm():
    mesh = shapes.arm_link(0.32, 0.055)
    t = head("Assimp Exporter", "millimeter", "0.001", "Z_UP")
    t += "<library_effects>\n"
    for name, rgb in (("metal", (0.64, 0.64, 0.64)), ("paint", (1, 1, 1))):
        t += f'<effect id="m{name}-fx" name="m{name}"><profile_COMMON><technique sid="standard"><phong><emission><color sid="emission">0 0 0 1</color></emission><ambient><color sid="ambient">0 0 0 1</color></ambient><diffuse><color sid="diffuse">{nums(rgb)} 1</color></diffuse><specular><color sid="specular">0.5 0.5 0.5 1</color></specular>'
        t += (
            '<shininess><float sid="shininess">50</float></shininess></phong></technique></profile_COMMON></effect>\n'
        )
    t += '</library_effects>\n<library_materials>\n<material id="mmetal" name="metal"><instance_effect url="#mmetal-fx"/></material>\n<material id="mpaint" name="paint"><instance_effect url="#mpaint-fx"/></material>\n</library_materials>\n<library_geometries>\n'
    parts = mesh.split()
    for k, (_, part) in enumerate(parts.items()):
        t += geometry(
            f"meshId{k}",
            part,
            lambda p: p,
            1000,
            "polylist",
            "none",
            False,
            lambda m: "theresonlyone",
            f"meshId{k}_name",
        )
    t += '</library_geometries>\n<library_visual_scenes><visual_scene id="myScene" name="myScene">\n<node id="forearm_roll" name="forearm_roll"><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>\n'
    for k, name in enumerate(parts):
        t += f'<instance_geometry url="#meshId{k}"><bind_material><technique_common><instance_material symbol="theresonlyone" target="#m{name}"/></technique_common></bind_material></instance_geometry>\n'
    save(
        "pr2/meshes/forearm.dae",
        t
        + '</node>\n</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene url="#myScene"/></scene>\n</COLLADA>\n',
    )


# 6. Blender 2.80 ----------------------------------------------------------------------------------------------------------------------


def lamp_blender280():
    looks = {"metal": (0.25, 0.25, 0.28), "red": (0.8, 0.1, 0.06), "glow": (1, 0.9, 0.7), "wood": (0.3, 0.16, 0.06)}
    t = head(
        "Blender 2.80.75 commit date:2019-07-29, commit time:14:47, hash:f6cb5f54494e",
        "meter",
        "1",
        "Z_UP",
        "1.4.1",
        "<author>Blender User</author>",
    )
    t += '<library_cameras><camera id="Camera-camera" name="Camera"><optics><technique_common><perspective><xfov sid="xfov">39.59775</xfov><aspect_ratio>1.777778</aspect_ratio><znear sid="znear">0.1</znear><zfar sid="zfar">100</zfar></perspective></technique_common></optics><extra><technique profile="blender"><shiftx sid="shiftx" type="float">0</shiftx><shifty sid="shifty" type="float">0</shifty></technique></extra></camera></library_cameras>\n'
    t += '<library_lights>\n<light id="Light-light" name="Light"><technique_common><point><color sid="color">1000 1000 1000</color><constant_attenuation>1</constant_attenuation><linear_attenuation>0</linear_attenuation><quadratic_attenuation>0.00111109</quadratic_attenuation></point></technique_common>'
    t += '<extra><technique profile="blender"><type sid="type" type="int">0</type><flag sid="flag" type="int">0</flag><mode sid="mode" type="int">1</mode><gamma sid="blender_gamma" type="float">1</gamma><red sid="red" type="float">1</red><green sid="green" type="float">1</green><blue sid="blue" type="float">1</blue><energy sid="blender_energy" type="float">1000</energy><dist sid="blender_dist" type="float">29.99998</dist></technique></extra></light>\n</library_lights>\n<library_images/>\n<library_effects>\n'
    for name, rgb in looks.items():
        t += f'<effect id="{name}-effect"><profile_COMMON><technique sid="common"><lambert><emission><color sid="emission">{"1 0.9 0.7 1" if name == "glow" else "0 0 0 1"}</color></emission><diffuse><color sid="diffuse">{nums(rgb)} 1</color></diffuse><index_of_refraction><float sid="ior">1.45</float></index_of_refraction></lambert></technique></profile_COMMON></effect>\n'
    t += (
        "</library_effects>\n<library_materials>\n"
        + "".join(
            f'<material id="{m}-material" name="{m}"><instance_effect url="#{m}-effect"/></material>\n' for m in looks
        )
        + "</library_materials>\n<library_geometries>\n"
    )
    t += geometry(
        "Lamp_body-mesh",
        shapes.desk_lamp(),
        lambda p: p,
        10,
        "triangles",
        "smooth",
        True,
        lambda m: f"{m}-material",
        "Lamp_body",
    )
    t += (
        geometry(
            "Desk-mesh",
            shapes.block(0, 0, -0.1, 16, 10, 0.2, "wood"),
            lambda p: p,
            1,
            "triangles",
            "flat",
            True,
            lambda m: f"{m}-material",
            "Desk",
        )
        + "</library_geometries>\n"
    )
    t += '<library_visual_scenes><visual_scene id="Scene" name="Scene">\n<node id="Camera" name="Camera" type="NODE"><matrix sid="transform">0.6859207 -0.3240135 0.6515582 9.358891 0.7276763 0.3054208 -0.6141704 -8.925792 0 0.8953956 0.4452714 8.958309 0 0 0 1</matrix><instance_camera url="#Camera-camera"/></node>\n'
    t += '<node id="Light" name="Light" type="NODE"><matrix sid="transform">-0.2908646 -0.7711008 0.5663932 4.076245 0.9551712 -0.1998834 0.2183912 1.005454 -0.05518906 0.6045247 0.7946723 5.903862 0 0 0 1</matrix><instance_light url="#Light-light"/></node>\n'
    for node, mesh in (("Lamp_body", shapes.desk_lamp()), ("Desk", shapes.block(0, 0, 0, 1, 1, 1, "wood"))):
        binds = "".join(
            f'<instance_material symbol="{m}-material" target="#{m}-material"><bind_vertex_input semantic="UVMap" input_semantic="TEXCOORD" input_set="0"/></instance_material>'
            for m in mesh.materials()
        )
        t += f'<node id="{node}" name="{node}" type="NODE"><matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix><instance_geometry url="#{node}-mesh" name="{node}"><bind_material><technique_common>{binds}</technique_common></bind_material></instance_geometry></node>\n'
    save(
        "lamp_blender280.dae",
        t
        + '</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene url="#Scene"/></scene>\n</COLLADA>\n',
    )


# 7. Torque ----------------------------------------------------------------------------------------------------------------------------


def barrel_torque():
    body, lid = shapes.barrel(), shapes.lathe([(0.2, 0.9), (0.21, 0.93), (0.05, 1.0)], 12, "lid")
    both = shapes.Mesh().join(body).join(lid)
    picture("barrel_rust.png", shapes.brick)
    t = head("Blender 2.62 with torque exporter", "meter", "1", "Z_UP")
    t += '<library_images><image id="rust" name="rust"><init_from>.\\barrel_rust.png</init_from></image></library_images>\n<library_effects>\n'
    t += '<effect id="paint-fx"><profile_COMMON><newparam sid="rust-surface"><surface type="2D"><init_from>rust</init_from></surface></newparam><newparam sid="rust-sampler"><sampler2D><source>rust-surface</source></sampler2D></newparam><technique sid="common"><lambert><diffuse><texture texture="rust-sampler" texcoord="UVMap"/></diffuse></lambert></technique></profile_COMMON></effect>\n'
    t += f'<effect id="lid-fx"><profile_COMMON><technique sid="common"><lambert>{color("diffuse", (0.4, 0.42, 0.45))}</lambert></technique></profile_COMMON></effect>\n</library_effects>\n'
    t += '<library_materials><material id="paint" name="paint"><instance_effect url="#paint-fx"/></material><material id="lid" name="lid"><instance_effect url="#lid-fx"/></material></library_materials>\n<library_geometries>\n'
    t += geometry("barrel2-mesh", both, lambda p: p, 1, "triangles", "smooth", True) + geometry(
        "Col-1-mesh",
        shapes.cylinder((0, 0, 0.05), (0, 0, 0.85), 0.2, 6, "none"),
        lambda p: p,
        1,
        "triangles",
        "flat",
        False,
    )
    t += "</library_geometries>\n"
    n = len(both.points)
    t += '<library_controllers><controller id="barrel-skin"><skin source="#barrel2-mesh"><bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>\n'
    t += '<source id="bj"><Name_array id="bj-a" count="2">bone_body bone_lid</Name_array><technique_common><accessor source="#bj-a" count="2"><param name="JOINT" type="name"/></accessor></technique_common></source>\n'
    t += '<source id="bb"><float_array id="bb-a" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0 1 0 0 0 0 1 -0.9 0 0 0 1</float_array><technique_common><accessor source="#bb-a" count="2" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>\n'
    t += '<source id="bw"><float_array id="bw-a" count="1">1</float_array><technique_common><accessor source="#bw-a" count="1" stride="1"><param name="WEIGHT" type="float"/></accessor></technique_common></source>\n'
    t += '<joints><input semantic="JOINT" source="#bj"/><input semantic="INV_BIND_MATRIX" source="#bb"/></joints>\n'
    t += f'<vertex_weights count="{n}"><input semantic="JOINT" source="#bj" offset="0"/><input semantic="WEIGHT" source="#bw" offset="1"/><vcount>{"1 " * n}</vcount><v>{" ".join("0 0" if k < len(body.points) else "1 0" for k in range(n))}</v></vertex_weights></skin></controller></library_controllers>\n'
    binds = '<bind_material><technique_common><instance_material symbol="paint" target="#paint"><bind_vertex_input semantic="UVMap" input_semantic="TEXCOORD" input_set="0"/></instance_material><instance_material symbol="lid" target="#lid"/></technique_common></bind_material>'
    t += '<library_visual_scenes><visual_scene id="Scene" name="Scene">\n<node id="bounds" name="bounds"><translate>0 0 0.5</translate></node>\n<node id="base01" name="base01">\n<node id="start01" name="start01">\n'
    t += '<node id="bone_body" name="bone_body" sid="bone_body" type="JOINT"><translate>0 0 0</translate></node>\n<node id="bone_lid" name="bone_lid" sid="bone_lid" type="JOINT"><translate>0 0 0.9</translate></node>\n'
    t += f'<node id="barrel2" name="barrel2"><instance_controller url="#barrel-skin"><skeleton>#bone_body</skeleton><skeleton>#bone_lid</skeleton>{binds}</instance_controller></node>\n'
    t += '<node id="Col-1" name="Col-1"><instance_geometry url="#Col-1-mesh"/></node>\n</node>\n<node id="detail2" name="detail2"/>\n</node>\n</visual_scene></library_visual_scenes>\n'
    save("barrel_torque.dae", t + '<scene><instance_visual_scene url="#Scene"/></scene>\n</COLLADA>\n')


# 8. a city in UTM ---------------------------------------------------------------------------------------------------------------------


def quarter_utm():
    mesh = shapes.city(12, 5)
    looks = {"wall": (0.8, 0.78, 0.7), "roof": (0.7, 0.25, 0.15), "grass": (0.35, 0.5, 0.3)}
    t = head("3D City Database", "meter", "1", "Z_UP", "1.4.0")
    t += "<library_effects>\n"
    for name, rgb in looks.items():
        t += f'<effect id="{name}-fx"><profile_COMMON><technique sid="c"><lambert>{color("emission", (0, 0, 0))}{color("ambient", rgb)}{color("diffuse", rgb)}</lambert></technique></profile_COMMON></effect>\n'
    t += (
        "</library_effects>\n<library_materials>\n"
        + "".join(f'<material id="{m}-mat"><instance_effect url="#{m}-fx"/></material>\n' for m in looks)
        + "</library_materials>\n<library_geometries>\n"
    )
    t += (
        geometry(
            "quarter",
            mesh,
            lambda p: (p[0] + 691234.5, p[1] + 5335987.25, p[2] + 519.3),
            1,
            "triangles",
            "none",
            False,
            lambda m: f"{m}-mat",
        )
        + "</library_geometries>\n"
    )
    binds = "".join(f'<instance_material symbol="{m}-mat" target="#{m}-mat"/>' for m in looks)
    t += f'<library_visual_scenes><visual_scene id="vs"><node id="n"><instance_geometry url="#quarter"><bind_material><technique_common>{binds}</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>\n'
    save("quarter_utm.dae", t + '<scene><instance_visual_scene url="#vs"/></scene>\n</COLLADA>\n')


# 9. a tree of leaf cards --------------------------------------------------------------------------------------------------------------


def tree_warehouse():
    mesh = shapes.tree()
    picture("textures/leaf.png", shapes.leaf, 64, 4)
    picture("textures/bark.png", shapes.planks)
    t = head("Trimble SketchUp 13.0.4812", "meter", "1", "Y_UP", "1.5.0")
    t += '<library_images><image id="leaf"><init_from><ref>textures/leaf.png</ref></init_from></image><image id="bark"><init_from><ref>textures/bark.png</ref></init_from></image></library_images>\n<library_effects>\n'
    for name, image in (("leaves", "leaf"), ("bark", "bark")):
        clear = (
            '<transparent opaque="A_ONE"><texture texture="sampler" texcoord="UV"/></transparent><transparency><float>1</float></transparency>'
            if name == "leaves"
            else ""
        )
        t += f'<effect id="{name}-fx"><profile_COMMON><newparam sid="sampler"><sampler2D><instance_image url="#{image}"/></sampler2D></newparam><technique sid="common"><lambert><diffuse><texture texture="sampler" texcoord="UV"/></diffuse>{clear}</lambert><extra><technique profile="GOOGLEEARTH"><double_sided>1</double_sided></technique></extra></technique></profile_COMMON></effect>\n'
    t += '</library_effects>\n<library_materials><material id="leaves"><instance_effect url="#leaves-fx"/></material><material id="bark"><instance_effect url="#bark-fx"/></material></library_materials>\n<library_geometries>\n'
    t += geometry("tree", mesh, y_up, 1, "triangles", "flat", True) + "</library_geometries>\n"
    binds = "".join(
        f'<instance_material symbol="{m}" target="#{m}"><bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="0"/></instance_material>'
        for m in ("leaves", "bark")
    )
    t += f'<library_visual_scenes><visual_scene id="vs"><node id="tree-node"><instance_geometry url="#tree"><bind_material><technique_common>{binds}</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>\n'
    save("tree_warehouse.dae", t + '<scene><instance_visual_scene url="#vs"/></scene>\n</COLLADA>\n')


# 10. FBX converter --------------------------------------------------------------------------------------------------------------------


def aeroplane_fbx():
    mesh = shapes.plane()
    picture("Skin_Blue.png", shapes.fabric)
    looks = {
        "paint": (1, 1, 1),
        "red": (0.8, 0.1, 0.1),
        "glass": (0.3, 0.4, 0.5),
        "wood": (0.5, 0.3, 0.1),
        "metal": (0.5, 0.5, 0.5),
    }
    t = head("FBX COLLADA exporter", "centimeter", "0.010000", "Y_UP", "1.4.1", "<author></author>")
    t += '<library_images>\n<image id="file1-image" name="file1"><init_from>C:\\Users\\artist\\Desktop\\plane\\skin_blue.PNG</init_from></image>\n</library_images>\n'
    t += '<library_lights><light id="directionalLight1-lib" name="directionalLight1"><technique_common><directional><color>1.000000 1.000000 1.000000</color></directional></technique_common></light></library_lights>\n<library_materials>\n'
    t += (
        "".join(f'<material id="{m}" name="{m}"><instance_effect url="#{m}-fx"/></material>\n' for m in looks)
        + "</library_materials>\n<library_effects>\n"
    )
    for name, rgb in looks.items():
        diffuse = (
            '<texture texture="file1-image" texcoord="CHANNEL0"><extra><technique profile="MAYA"><wrapU sid="wrapU0">TRUE</wrapU><wrapV sid="wrapV0">TRUE</wrapV><blend_mode>ADD</blend_mode></technique></extra></texture>'
            if name == "paint"
            else f'<color sid="diffuse">{nums(rgb)} 1</color>'
        )
        t += f'<effect id="{name}-fx" name="{name}"><profile_COMMON><technique sid="standard"><phong><emission><color sid="emission">0.000000 0.000000 0.000000 1.000000</color></emission><ambient><color sid="ambient">0.000000 0.000000 0.000000 1.000000</color></ambient><diffuse>{diffuse}</diffuse><specular><color sid="specular">0.500000 0.500000 0.500000 1.000000</color></specular><shininess><float sid="shininess">20.000000</float></shininess>'
        t += '<reflective><color sid="reflective">0.000000 0.000000 0.000000 1.000000</color></reflective><reflectivity><float sid="reflectivity">0.500000</float></reflectivity><transparent opaque="RGB_ZERO"><color sid="transparent">1.000000 1.000000 1.000000 1.000000</color></transparent><transparency><float sid="transparency">1.000000</float></transparency></phong></technique></profile_COMMON></effect>\n'
    t += (
        "</library_effects>\n<library_geometries>\n"
        + geometry("plane-lib", mesh, y_up, 100, "polygons", "smooth", True, str, "planeMesh")
        + "</library_geometries>\n"
    )
    binds = "".join(f'<instance_material symbol="{m}" target="#{m}"/>' for m in looks)
    t += '<library_visual_scenes><visual_scene id="RootNode" name="RootNode">\n'
    t += '<node id="directionalLight1" name="directionalLight1"><translate sid="translate">0 500 0</translate><rotate sid="rotateX">1 0 0 90</rotate><instance_light url="#directionalLight1-lib"/></node>\n'
    t += f'<node id="plane" name="plane"><rotate sid="rotateZ">0 0 1 0</rotate><rotate sid="rotateY">0 1 0 30</rotate><rotate sid="rotateX">1 0 0 0</rotate><instance_geometry url="#plane-lib"><bind_material><technique_common>{binds}</technique_common></bind_material></instance_geometry></node>\n'
    save(
        "aeroplane_fbx.dae",
        t
        + '</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene url="#RootNode"/></scene>\n</COLLADA>\n',
    )


for document in (
    cafe_table,
    house_sketchup,
    hatchback_max,
    officer_maya,
    forearm,
    lamp_blender280,
    barrel_torque,
    quarter_utm,
    tree_warehouse,
    aeroplane_fbx,
):
    document()
