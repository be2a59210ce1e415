// tests/runtime/scene_text.h: small COLLADA scenes written by tests, and their pictures.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/picture/frame/frame.h"
#include "runtime/scene/dae/import.h"
#include "runtime/scene/load/import_scene.h"
#include "runtime/scene/scene.h"

namespace kinora {

// The libraries of a document as text. The camera is orthographic at (0,0,10), looks along -z and
// shows [-1,1] x [-1,1] of the plane z = 0, unless `cameras_and_node` is replaced.
struct SceneText {
    std::string asset = R"(<unit name="meter" meter="1"/><up_axis>Y_UP</up_axis>)";
    std::string images, effects, materials, geometries, controllers, lights, animations;
    std::string library_nodes, nodes;
    std::string scene_extra;  // inside <visual_scene>, after its nodes
    std::string cameras = R"(<camera id="eye"><optics><technique_common><orthographic>
        <xmag>1</xmag><ymag>1</ymag><znear>0.1</znear><zfar>100</zfar>
        </orthographic></technique_common></optics></camera>)";
    std::string camera_node = R"(<node id="eye-node"><translate>0 0 10</translate>
        <instance_camera url="#eye"/></node>)";

    // An effect ID-fx of one shader a stage, and a material ID.
    SceneText& look(const std::string& id, const std::string& code,
                    const std::string& passes = "<shader stage=\"SURFACE\"/>",
                    const std::string& newparams = "", const std::string& material_extra = "");
    // An effect that the visual scene runs: its atmosphere, its imager.
    SceneText& scene_effect(const std::string& id, const std::string& code,
                            const std::string& passes);
    // A triangle mesh; normals and uvs are one a vertex, or empty.
    SceneText& mesh(const std::string& id, const std::vector<dvec3>& positions,
                    const std::vector<int>& triangles, const std::vector<dvec3>& normals = {},
                    const std::vector<dvec3>& uvs = {});
    // [-size, size] squared in the plane z = 0, normals +z, uv from 0 to 1.
    SceneText& square(const std::string& id, double size = 1);
    SceneText& octahedron(const std::string& id);  // unit, smooth normals
    // [-size, size] cubed, closed, without normals: flat faces.
    SceneText& cube(const std::string& id, double size = 1);
    // A node with the mesh in that look; `inside` goes into instance_material.
    SceneText& place(const std::string& mesh, const std::string& look,
                     const std::string& transforms = "", const std::string& node_id = "",
                     const std::string& inside = "");
    // A light with its own node; `kind` is the element below technique_common.
    SceneText& light(const std::string& id, const std::string& kind,
                     const std::string& transforms = "", const std::string& extra = "");
    // A light whose shader is RSL.
    SceneText& rsl_light(const std::string& id, const std::string& code,
                         const std::string& transforms = "", const std::string& binds = "");
    // LINEAR keys of one number.
    SceneText& animate(const std::string& target, const std::vector<double>& times,
                       const std::vector<double>& values);
    // A strip in the plane z = 0 from y = -1 to 1, skinned to joints at y = -1 and y = 0; the upper
    // one turns about z from 0 to 80 degrees in one second.
    SceneText& bending_strip(const std::string& id, const std::string& look, int segments);
    std::string text() const;
};

// A look that shows light and shade, and a light along -z.
inline const char* const kMatte = "surface matte() { Oi = 1; Ci = diffuse(normalize(N)); }";
inline const char* const kSun = "<directional><color>1 1 1</color></directional>";

// A square about the origin, more than what the default camera sees, in a look "floor-look".
SceneText floor_scene(const std::string& code,
                      const std::string& passes = "<shader stage=\"SURFACE\"/>");

// <extra> with an RSL technique around `inside`.
std::string rsl_extra(const std::string& inside);
std::string numbers(const std::vector<double>& values);
std::string numbers(const std::vector<dvec3>& values, int components = 3);

// A scene read from text (or a file) and built; its last picture.
struct Rendering {
    Diagnostics diagnostics;
    std::unique_ptr<Scene> scene;
    std::unique_ptr<Pose> pose;  // of the scene
    raytrace::Film film;
    FrameStats stats;
    FrameSettings settings;

    // 16 x 16 pixels, one sample each.
    explicit Rendering(const std::string& document, const SceneOptions& options = {});
    static std::unique_ptr<Rendering> of_file(const std::string& path,
                                              const SceneOptions& options = {});
    Rendering& frame(double time = 0);
    Rendering& frame(int width, int height, double time = 0);
    vec3 color(int x, int y) const { return vec3(film.at(x, y)); }
    // World x and y under a pixel's centre, for the default camera of SceneText.
    dvec2 place(int x, int y) const;
    int count(std::string_view code) const;
    const Finding* find(std::string_view code) const;  // the first
    std::string findings() const;                      // all, as printed
    LineColumn where(const Finding& finding) const;
    std::string file_text;

  private:
    Rendering() = default;
    void load(const std::string& path, const SceneOptions& options);
};

// The largest difference of any component.
float difference(const raytrace::Film& a, const raytrace::Film& b);
// Pixels where a component differs by more than `tolerance`.
size_t different_pixels(const raytrace::Film& a, const raytrace::Film& b, float tolerance);
bool same_bytes(const raytrace::Film& a, const raytrace::Film& b);

// Sets the threads for its scope.
class Threads {
  public:
    explicit Threads(int n);
    ~Threads();

  private:
    int before_;
};

}  // namespace kinora
