// tests/runtime/picture/light/lamp_classes.h: lamps of RSL 2.0 with sample methods, and the same
// shapes on geometry. All have the same radiance everywhere, and one side but for the sphere.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/runtime/scene_text.h"

namespace kinora {

// In the plane z = 0 of its space; it shines along z. Points are chosen evenly by area.
inline constexpr const char* kRectangleClass = R"(
class rectangle(uniform float wide = 1, tall = 0.6, samples = 16; uniform color radiance = 1;) {
    vector axis = 0;
    float density(vector D; float far) { return far * far / (wide * tall * max(1e-9, -(D . axis))); }
    void look() { axis = normalize(vector "shader" (0, 0, 1)); }
    public void generateSamples(string what; output __radiancesample s[]) {
        look();
        uniform float i;
        resize(s, samples);
        for (i = 0; i < samples; i += 1) {
            float x = (random() - 0.5) * wide, y = (random() - 0.5) * tall;
            vector way = point "shader" (x, y, 0) - Ps;
            float far = length(way);
            vector D = way / far;
            s[i]->setLightSample(D . axis < 0 ? radiance : 0, density(D, far), D, far);
        }
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        look();
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1) {
            vector D = s[i]->direction;
            float along = D . axis, far = ((point "shader" (0, 0, 0) - Ps) . axis) / along;
            point at = transform("shader", Ps + far * D);
            if (along < 0 && far > 0 && abs(at[0]) <= wide / 2 && abs(at[1]) <= tall / 2) {
                s[i]->setLightSample(radiance, density(D, far));
                s[i]->distance = far;
            }
        }
    }
})";

// The same of a disc.
inline constexpr const char* kDiscClass = R"(
class disc(uniform float radius = 0.5, samples = 16; uniform color radiance = 1;) {
    vector axis = 0;
    float density(vector D; float far) {
        return far * far / (PI * radius * radius * max(1e-9, -(D . axis)));
    }
    void look() { axis = normalize(vector "shader" (0, 0, 1)); }
    public void generateSamples(string what; output __radiancesample s[]) {
        look();
        uniform float i;
        resize(s, samples);
        for (i = 0; i < samples; i += 1) {
            float r = radius * sqrt(random()), a = 2 * PI * random();
            vector way = point "shader" (r * cos(a), r * sin(a), 0) - Ps;
            float far = length(way);
            vector D = way / far;
            s[i]->setLightSample(D . axis < 0 ? radiance : 0, density(D, far), D, far);
        }
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        look();
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1) {
            vector D = s[i]->direction;
            float along = D . axis, far = ((point "shader" (0, 0, 0) - Ps) . axis) / along;
            point at = transform("shader", Ps + far * D);
            if (along < 0 && far > 0 && at[0] * at[0] + at[1] * at[1] <= radius * radius) {
                s[i]->setLightSample(radiance, density(D, far));
                s[i]->distance = far;
            }
        }
    }
})";

// A sphere about the origin of its space, sampled evenly within the cone that it fills. Where the
// sphere is met follows from the sine of the angle to its middle: 1 - cosine is exact there.
inline constexpr const char* kSphereClass = R"(
class ball(uniform float radius = 0.4, samples = 16; uniform color radiance = 1;) {
    vector middle = 0;
    float far = 0, sine2 = 0, opening = 0, pdf = 0;
    void look() {
        middle = point "shader" (0, 0, 0) - Ps;
        far = length(middle);
        sine2 = min(1, radius * radius / (far * far));
        opening = sine2 / (1 + sqrt(1 - sine2));
        pdf = 1 / (2 * PI * opening);
    }
    float reach(float cosine; float off2) {
        return far * cosine - sqrt(max(0, radius * radius - far * far * off2));
    }
    public void generateSamples(string what; output __radiancesample s[]) {
        look();
        vector W = middle / far;
        vector T = normalize(abs(W[0]) < 0.9 ? W ^ vector(1, 0, 0) : W ^ vector(0, 1, 0));
        vector B = W ^ T;
        uniform float i;
        resize(s, samples);
        for (i = 0; i < samples; i += 1) {
            float down = random() * opening, a = 2 * PI * random();
            float off2 = down * (2 - down);
            vector D = W * (1 - down) + (T * cos(a) + B * sin(a)) * sqrt(off2);
            s[i]->setLightSample(radiance, pdf, D, reach(1 - down, off2));
        }
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        look();
        vector W = middle / far;
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1) {
            vector D = s[i]->direction, across = D ^ W;
            if (D . W > 0 && across . across <= sine2) {
                s[i]->setLightSample(radiance, pdf);
                s[i]->distance = reach(D . W, across . across);
            }
        }
    }
})";

struct LampClass {
    const char* name;
    const char* code;
};
inline constexpr LampClass kLampClasses[] = {
    {"rectangle", kRectangleClass}, {"disc", kDiscClass}, {"sphere", kSphereClass}};
inline constexpr double kLampWide = 1, kLampTall = 0.6, kDiscRadius = 0.5, kSphereRadius = 0.4,
                        kLampHeight = 2;

inline std::string bound_number(const char* symbol, double value) {
    return fmt::format("<bind symbol=\"{}\"><float>{}</float></bind>", symbol, value);
}

// ---- on geometry --------------------------------------------------------------------------------

// A LIGHT shader whose mesh, of that area, has the radiance on the side of its normals.
inline std::string geometry_lamp(double area, double radiance = 1) {
    return fmt::format(
        "light lamp() {{ illuminate(P, N, PI/2)"
        " Cl = {} / PI * (normalize(L) . normalize(N)) / (L . L); }}",
        area * radiance);
}

struct LampMesh {
    std::vector<dvec3> positions;
    std::vector<int> triangles;
    double area = 0;
    std::vector<dvec3> normals = {};  // of the vertices; none: they are found
};

// The rectangle in the plane z = 0, which looks along -z.
inline LampMesh rectangle_mesh(double wide = kLampWide, double tall = kLampTall) {
    const double x = wide / 2, y = tall / 2;
    return {{{-x, -y, 0}, {-x, y, 0}, {x, y, 0}, {x, -y, 0}}, {0, 1, 2, 0, 2, 3}, wide * tall};
}
inline LampMesh disc_mesh() {
    constexpr int kCorners = 512;
    LampMesh mesh;
    mesh.area = kPi * kDiscRadius * kDiscRadius;
    mesh.positions.push_back({0, 0, 0});
    for (int k = 0; k < kCorners; ++k) {
        const double a = 2 * kPi * k / kCorners;
        mesh.positions.push_back({kDiscRadius * std::cos(a), kDiscRadius * std::sin(a), 0});
        for (int corner : {0, (k + 1) % kCorners + 1, k + 1}) mesh.triangles.push_back(corner);
    }
    return mesh;
}
// Rings between the poles, whose flat facets share no vertices.
inline LampMesh sphere_mesh(int rings, int sectors) {
    LampMesh mesh;
    auto at = [&](int i, int j) {
        const double down = kPi * i / rings, turn = 2 * kPi * j / sectors;
        return kSphereRadius * dvec3(std::sin(down) * std::cos(turn),
                                     std::sin(down) * std::sin(turn), std::cos(down));
    };
    auto facet = [&](dvec3 a, dvec3 b, dvec3 c) {
        const dvec3 across = glm::cross(b - a, c - a);
        mesh.area += glm::length(across) / 2;
        for (const dvec3& corner : {a, b, c}) {
            mesh.triangles.push_back(int(mesh.positions.size()));
            mesh.positions.push_back(corner);
            mesh.normals.push_back(glm::normalize(across));
        }
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            if (i > 0) facet(at(i, j), at(i + 1, j), at(i, j + 1));
            if (i < rings - 1) facet(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
        }
    return mesh;
}

// Its middle is that high above the origin.
inline void add_lamp(SceneText& scene, const LampMesh& mesh, double radiance = 1,
                     double height = kLampHeight) {
    scene.look("lamp-look", geometry_lamp(mesh.area, radiance), "<shader stage=\"LIGHT\"/>");
    scene.mesh("lamp", mesh.positions, mesh.triangles, mesh.normals);
    scene.place("lamp", "lamp-look", fmt::format("<translate>0 0 {}</translate>", height));
}

// The camera stands below the lamps and sees the floor as it does from 10.
inline void look_from_below(SceneText& scene, double height) {
    scene.camera_node = fmt::format(
        "<node id=\"eye-node\"><translate>0 0 {}</translate>"
        "<instance_camera url=\"#eye\"/></node>",
        height);
}

// All samples of a pixel lie at its middle, and share their sequences.
inline void sample_middles(Rendering& r, int samples) {
    r.settings.integrator.samples_per_pixel = samples;
    r.settings.integrator.filter_width = 1e-6;
}

}  // namespace kinora
