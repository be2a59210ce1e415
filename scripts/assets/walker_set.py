# scripts/assets/walker_set.py: the gallery the walker crosses, its lights and its camera.
import math

import bmesh
import bpy
from mathutils import Vector

import walker_gait as gait

WALL_Y = 2.3  # the back wall; the walk is along y = 0 and the camera is at negative y


def add_mesh(name, material, vertices, faces, smooth=False, place=(0, 0, 0)):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(mesh.polygons))
    mesh.materials.append(material)
    return add_object(name, mesh, place)


def add_object(name, mesh, place):
    thing = bpy.data.objects.new(name, mesh)
    thing.location = place
    bpy.context.collection.objects.link(thing)
    return thing


def add_box(name, material, low, high, bevel=0.0):
    """An axis-aligned box, its edges rounded."""
    mesh = bpy.data.meshes.new(name)
    bm = bmesh.new()
    bmesh.ops.create_cube(bm, size=1.0)
    size = [high[i] - low[i] for i in range(3)]
    bmesh.ops.scale(bm, vec=size, verts=bm.verts)
    if bevel > 0:
        bmesh.ops.bevel(bm, geom=bm.edges[:], offset=bevel, segments=2, profile=0.6,
                        affect="EDGES")
    bm.to_mesh(mesh)
    bm.free()
    mesh.materials.append(material)
    return add_object(name, mesh, [(low[i] + high[i]) / 2 for i in range(3)])


def lathe(profile, segments, flutes=0, depth=0.0):
    """Rings of (radius, z, fluted 0..1), closed with caps."""
    vertices, faces = [], []
    for radius, z, fluted in profile:
        for i in range(segments):
            a = 2 * math.pi * i / segments
            groove = depth * fluted * abs(math.sin(0.5 * flutes * a)) ** 0.8
            vertices.append(((radius - groove) * math.cos(a), (radius - groove) * math.sin(a), z))
    for ring in range(len(profile) - 1):
        for i in range(segments):
            j = (i + 1) % segments
            a, b = ring * segments, (ring + 1) * segments
            faces.append((a + i, a + j, b + j, b + i))
    faces.append(tuple(reversed(range(segments))))
    faces.append(tuple(range(len(vertices) - segments, len(vertices))))
    return vertices, faces


def half_round(radius, z, height, bulge, steps=6):
    """A convex moulding (torus) of a column's base or capital."""
    return [(radius + bulge * math.sin(math.pi * i / steps),
             z + height * (1 - math.cos(math.pi * i / steps)) / 2, 0.0) for i in range(steps + 1)]


def column_profile(height):
    profile = half_round(0.235, 0.10, 0.085, 0.035)
    profile += half_round(0.215, 0.20, 0.05, 0.02)
    profile += [(0.200, 0.26, 0.0), (0.196, 0.30, 1.0)]
    profile += [(0.196 - 0.030 * t * t, 0.30 + (height - 0.72) * t, 1.0)
                for t in (0.25, 0.5, 0.75, 1.0)]
    top = height - 0.42
    profile += [(0.168, top + 0.05, 0.0)]
    profile += half_round(0.170, top + 0.06, 0.045, 0.014)
    profile += half_round(0.172, top + 0.13, 0.13, 0.060)
    return profile


def build_columns(stone, places, height=3.6):
    vertices, faces = lathe(column_profile(height), 96, 16, 0.020)
    shaft = add_mesh("column", stone, vertices, faces, True, places[0])
    shaft.data.use_auto_smooth = True
    for i, place in enumerate(places[1:]):
        add_object(f"column.{i + 2}", shaft.data, place)
    for i, (x, y, z) in enumerate(places):
        add_box(f"plinth.{i + 1}", stone, (x - 0.29, y - 0.29, z), (x + 0.29, y + 0.29, z + 0.10),
                0.012)
        add_box(f"abacus.{i + 1}", stone, (x - 0.27, y - 0.27, z + height - 0.17),
                (x + 0.27, y + 0.27, z + height - 0.06), 0.012)


def build_frame(name, material, x0, x1, z0, z1, y, width=0.07, depth=0.035):
    """A moulding around a wall panel: a picture-frame profile along a rectangle."""
    section = [(0, 0), (0.25, 0.75), (0.45, 1.0), (0.7, 0.55), (0.85, 0.6), (1.0, 0)]
    vertices, faces = [], []
    for inset, out in section:
        d = inset * width
        yy = y - out * depth
        vertices += [(x0 + d, yy, z0 + d), (x1 - d, yy, z0 + d), (x1 - d, yy, z1 - d),
                     (x0 + d, yy, z1 - d)]
    for k in range(len(section) - 1):
        for i in range(4):
            j = (i + 1) % 4
            faces.append((4 * k + i, 4 * k + j, 4 * k + 4 + j, 4 * k + 4 + i))
    add_mesh(name, material, vertices, faces)


def build_knot(material, place, size=0.26, tube=0.075):
    """A trefoil knot: the modern piece of the collection."""
    around, along = 18, 132
    vertices, faces = [], []

    def curve(t):
        return Vector((math.sin(t) + 2 * math.sin(2 * t), -math.sin(3 * t),
                       math.cos(t) - 2 * math.cos(2 * t))) * (size / 3)

    for i in range(along):
        t = 2 * math.pi * i / along
        tangent = (curve(t + 1e-3) - curve(t - 1e-3)).normalized()
        a = tangent.cross(Vector((0, 1, 0))).normalized()
        b = tangent.cross(a)
        for j in range(around):
            s = 2 * math.pi * j / around
            vertices.append(tuple(curve(t) + tube * (math.cos(s) * a + math.sin(s) * b)))
            ii, jj = (i + 1) % along, (j + 1) % around
            faces.append((i * around + j, i * around + jj, ii * around + jj, ii * around + j))
    add_mesh("knot", material, vertices, faces, True, place)


def build_pedestal(name, stone, x, y, top, half=0.27):
    add_box(name + ".foot", stone, (x - half - 0.06, y - half - 0.06, 0),
            (x + half + 0.06, y + half + 0.06, 0.12), 0.014)
    add_box(name + ".die", stone, (x - half, y - half, 0.12), (x + half, y + half, top - 0.08),
            0.008)
    add_box(name + ".cap", stone, (x - half - 0.05, y - half - 0.05, top - 0.08),
            (x + half + 0.05, y + half + 0.05, top), 0.014)


def build_room(m):
    add_mesh("floor", m["planks"], [(-7, -6, 0), (7, -6, 0), (7, WALL_Y, 0), (-7, WALL_Y, 0)],
             [(0, 1, 2, 3)])
    add_mesh("wall", m["wall"], [(-7, WALL_Y, 0), (7, WALL_Y, 0), (7, WALL_Y, 4.2),
                                 (-7, WALL_Y, 4.2)], [(0, 1, 2, 3)])
    add_box("skirting", m["trim"], (-7, WALL_Y - 0.035, 0), (7, WALL_Y, 0.20), 0.012)
    add_box("rail", m["trim"], (-7, WALL_Y - 0.05, 0.98), (7, WALL_Y, 1.05), 0.014)
    for i in range(-3, 4):
        x = 1.9 * i
        build_frame(f"panel.{i + 4}", m["trim"], x - 0.78, x + 0.78, 1.22, 3.6, WALL_Y)
        build_frame(f"dado.{i + 4}", m["trim"], x - 0.78, x + 0.78, 0.33, 0.86, WALL_Y, 0.05, 0.025)
    build_columns(m["stone"], [(x, 1.75, 0) for x in (-4.75, -0.95, 2.85)])
    # He came down from here: an empty pedestal with two steps before it.
    build_pedestal("pedestal", m["stone"], -2.75, 1.25, 0.62, 0.34)
    add_box("step.1", m["stone"], (-3.25, 0.42, 0), (-2.25, 0.86, 0.16), 0.012)
    add_box("step.2", m["stone"], (-3.15, 0.62, 0.16), (-2.35, 0.86, 0.32), 0.012)
    add_box("plaque", m["brass"], (-2.92, 0.895, 0.30), (-2.58, 0.91, 0.44), 0.004)
    build_pedestal("plinth", m["stone"], 1.0, 1.30, 0.92, 0.22)
    build_knot(m["knot"], (1.0, 1.30, 1.29))


def add_light(name, kind, place, target, energy):
    light = bpy.data.lights.new(name, kind)
    light.energy = energy
    thing = bpy.data.objects.new(name, light)
    thing.location = place
    thing.rotation_euler = (Vector(target) - Vector(place)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.collection.objects.link(thing)
    return thing


def build_lights():
    """add_rsl.py gives the lights their shaders by these names."""
    key = add_light("key", "SPOT", (-3.3, -4.2, 4.6), (0.0, 0.3, 0.8), 1000)
    key.data.spot_size = math.radians(62)
    add_light("rim", "SPOT", (4.2, 1.6, 3.9), (0.0, 0.0, 0.9), 400)
    add_light("sky", "SUN", (0, 0, 4), (0, 0, 0), 1)


def build_camera():
    """A slow dolly that keeps ahead of the walker and lets him come nearer."""
    camera = bpy.data.cameras.new("camera")
    camera.lens, camera.sensor_width = 38, 36
    camera.clip_start, camera.clip_end = 0.1, 40
    thing = bpy.data.objects.new("camera", camera)
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing
    thing.rotation_mode = "XYZ"
    for frame in range(1, gait.FRAMES + 1, 3):
        t = (frame - 1) / (gait.FRAMES - 1)
        t = t * t * (3 - 2 * t) * 0.6 + 0.4 * t
        walker = gait.START + gait.STRIDE * gait.FRAMES / gait.CYCLE * (frame - 1) / gait.FRAMES
        thing.location = (0.55 + 2.0 * t, -3.35 - 0.25 * t, 1.02 + 0.25 * t)
        look = Vector((0.80 * walker + 0.42, 0.25, 0.94 - 0.03 * t))
        direction = look - thing.location
        thing.rotation_euler = direction.to_track_quat("-Z", "Y").to_euler()
        thing.keyframe_insert("location", frame=frame)
        thing.keyframe_insert("rotation_euler", frame=frame)
