// tests/runtime/scene/ri/rib_scene.h: RIB written by tests: its worlds as descriptions, and its
// pictures.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "runtime/kinora/kinora.h"
#include "runtime/scene/ri/import/import.h"

namespace kinora::ri {

// A primitive as a world holds it.
struct Described {
    dmat4 to_camera{1.0};
    const MeshDefinition* mesh = nullptr;
    const MaterialDefinition* material = nullptr;
    std::optional<std::vector<uint32_t>> lights;

    dvec3 place(dvec3 p) const { return dvec3(to_camera * dvec4(p, 1)); }
    // Of the box about it, in camera space.
    dvec3 center() const {
        dvec3 low(1e300), high(-1e300);
        for (const dvec3& p : mesh->positions)
            low = glm::min(low, place(p)), high = glm::max(high, place(p));
        return (low + high) / 2.0;
    }
};

inline std::string findings_of(const Diagnostics& diagnostics) {
    std::string text;
    for (const Finding& finding : diagnostics.findings())
        text += format_finding(finding, diagnostics.files);
    return text;
}

inline int count_of(const Diagnostics& diagnostics, std::string_view code) {
    int n = 0;
    for (const Finding& finding : diagnostics.findings()) n += finding.info->code == code;
    return n;
}

// Of a node, from its own space to the camera of the interface (z into the picture).
inline dmat4 camera_matrix(const SceneDescription& world, const NodeDefinition& node) {
    dmat4 m(1.0);
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
            m[c][r] =
                (r == 2 ? -1 : 1) * world.values[node.transforms[0].value + size_t(4 * r + c)];
    return m;
}

inline dvec3 color_of(const SceneDescription& world, const Described& primitive,
                      const char* name = "Cs") {
    const ParamSource* source = primitive.material->surfaces[0].find(name);
    if (!source || source->value.count != 3) return dvec3(-1);
    const double* at = &world.values[source->value.offset];
    return {at[0], at[1], at[2]};
}

// All worlds of a text.
struct RibWorlds {
    Diagnostics diagnostics;
    std::vector<SceneDescription> worlds;
    bool read = false;

    explicit RibWorlds(const std::string& text, const std::string& path = "x.rib") {
        diagnostics.judge(Judgement::Rendering);
        read = read_rib({path, text}, {}, diagnostics, [&](SceneDescription&& world) {
            worlds.push_back(std::move(world));
            return true;
        });
    }
    int count(std::string_view code) const { return count_of(diagnostics, code); }
    std::string findings() const { return findings_of(diagnostics); }
    const SceneDescription& world(size_t at = 0) const {
        static const SceneDescription kEmpty;
        if (at >= worlds.size()) ADD_FAILURE() << "no world " << at << '\n' << findings();
        return at < worlds.size() ? worlds[at] : kEmpty;
    }
    const FilePicture& picture(size_t at = 0) const {
        static const FilePicture kNone;
        return world(at).file_picture ? *world(at).file_picture : kNone;
    }
    // In the order in which they came.
    std::vector<Described> primitives(size_t at = 0) const {
        const SceneDescription& from = world(at);
        std::vector<std::pair<uint32_t, Described>> found;
        for (const NodeDefinition& node : from.nodes)
            for (const MeshUse& use : node.meshes)
                found.push_back({use.mesh,
                                 {camera_matrix(from, node), &from.meshes[use.mesh],
                                  &from.materials[use.materials[0].material], use.lights}});
        std::ranges::stable_sort(found, {}, [](const auto& one) { return one.first; });
        std::vector<Described> made;
        for (auto& one : found) made.push_back(std::move(one.second));
        return made;
    }
    Described primitive(size_t number = 0, size_t at = 0) const {
        static const MeshDefinition kNoMesh;
        static const MaterialDefinition kNoMaterial = [] {
            MaterialDefinition bare;
            bare.surfaces.resize(1);
            return bare;
        }();
        std::vector<Described> all = primitives(at);
        if (number < all.size()) return all[number];
        ADD_FAILURE() << "no primitive " << number << '\n' << findings();
        return {dmat4(1.0), &kNoMesh, &kNoMaterial, {}};
    }
};

inline void expect_near(dvec3 got, dvec3 want, double tolerance = 1e-5) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], want[k], tolerance) << "component " << k;
}

// A picture of 16 by 16 pixels with a sample in the middle of each: [-1,1] x [-1,1], from z = 0 on.
inline const std::string kSmall =
    "Format 16 16 1 PixelSamples 1 1 PixelFilter \"box\" 1 1 Display \"x\" \"file\" \"rgba\" ";

// The picture of the text's last world.
struct RibPicture {
    OpenScene scene;
    raytrace::Film film;

    explicit RibPicture(const std::string& text, const std::string& path = "x.rib")
        : scene(request_of(path)) {
        SceneError error = scene.open(text);
        EXPECT_EQ(error, SceneError::None) << findings();
        if (error == SceneError::None) {
            EXPECT_TRUE(scene.render(0, film)) << findings();
        }
    }
    static SceneRequest request_of(const std::string& path) {
        SceneRequest request;
        request.scene = path;
        request.quality = *find_quality(kDefaultQuality);
        request.lights = LightSet::Scene;
        request.displays = true;
        return request;
    }
    std::string findings() const { return findings_of(scene.diagnostics()); }
    int count(std::string_view code) const { return count_of(scene.diagnostics(), code); }
    vec4 at(int x, int y) const {
        return x < film.width && y < film.height ? film.at(x, y) : vec4(-1);
    }
    // A plane of the film; -1: there is none of that name.
    float plane(const std::string& name, int x, int y) const {
        for (const raytrace::AovPlane& plane : film.aovs)
            if (plane.name == name) return plane.values[size_t(y * film.width + x)];
        return -1;
    }
    bool covers(int x, int y) const { return at(x, y).w > 0.5f; }
    int covered() const {
        return int(std::ranges::count_if(film.rgba, [](vec4 pixel) { return pixel.w > 0.5f; }));
    }
    void expect(int x, int y, dvec3 color, double tolerance = 1e-5) const {
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(at(x, y)[k], color[k], tolerance)
                << "pixel " << x << ',' << y << " component " << k << '\n'
                << findings();
    }
};

// A folder with shaders, archives and the like, as long as this lives.
class RibFolder {
  public:
    RibFolder() {
        static int number = 0;
        folder_ = (std::filesystem::temp_directory_path() /
                   ("kinora_rib_" + std::to_string(getpid()) + "_" + std::to_string(number++)))
                      .string();
        std::filesystem::create_directories(folder_);
    }
    ~RibFolder() {
        std::error_code error;
        std::filesystem::remove_all(folder_, error);
    }
    RibFolder(const RibFolder&) = delete;

    RibFolder& file(const std::string& name, const std::string& content) {
        std::filesystem::path path = std::filesystem::path(folder_) / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << content;
        return *this;
    }
    const std::string& path() const { return folder_; }
    // Option "searchpath" for a kind.
    std::string search(const std::string& kind = "shader") const {
        return "Option \"searchpath\" \"string " + kind + "\" [\"" + folder_ + "\"] ";
    }

  private:
    std::string folder_;
};

// Shaders that show what they are given, halved and moved to [0, 1].
inline const char* const kShowN =
    "surface show_n() { normal n = normalize(ntransform(\"camera\", N)); Oi = 1;"
    " Ci = 0.5 + 0.5 * color(xcomp(n), ycomp(n), zcomp(n)); }";
inline const char* const kShowP =
    "surface show_p(string space = \"shader\";) { point p = transform(space, P); Oi = 1;"
    " Ci = 0.5 + 0.5 * color(xcomp(p), ycomp(p), zcomp(p)); }";
inline const char* const kShowSt = "surface show_s_t() { Oi = 1; Ci = color(s, t, 0); }";
inline const char* const kShowUv = "surface show_u_v() { Oi = 1; Ci = color(u, v, 0); }";

inline dvec3 shown(dvec3 value) {
    return 0.5 + 0.5 * value;
}

}  // namespace kinora::ri
