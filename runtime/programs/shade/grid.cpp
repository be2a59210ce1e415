// runtime/programs/shade/grid.cpp: points of a square and a sphere with their derivatives.
#include "runtime/programs/shade/grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "runtime/scene/kernels/columns.h"

namespace kinora {

namespace {

using rsl::Global;
using rsl::KernelKey;
using rsl::KeyKind;

constexpr double kNear = 1.0, kFar = 100.0;
constexpr double kSquareDistance = 2.0;  // the square fills the picture from there
constexpr double kSphereDistance = 4.0;
constexpr double kSphereWindow = 1.1;  // of the radius, at the sphere's silhouette

// A well mixed 32-bit hash of the pixel, as a renderer gives
// (docs/decisions.md#random-numbers-without-state).
float pixel_hash(uint32_t pixel) {
    uint32_t h = pixel * 0x9e3779b9u + 0x7f4a7c15u;
    h = (h ^ (h >> 16)) * 0x21f0aaadu;
    h = (h ^ (h >> 15)) * 0x735a2d97u;
    return std::bit_cast<float>(h ^ (h >> 15));
}

// Three columns, or one, and what they hold.
struct TripleRow {
    uint16_t first;
    vec3 PatchPoint::*member;
};
// The eye is at 0, so I = P; lights are asked at P.
constexpr TripleRow kTriples[] = {
    {kColP, &PatchPoint::P},       {kColPs, &PatchPoint::P},      {kColI, &PatchPoint::P},
    {kColdPdu, &PatchPoint::dPdu}, {kColdIdu, &PatchPoint::dPdu}, {kColdPdv, &PatchPoint::dPdv},
    {kColdIdv, &PatchPoint::dPdv}, {kColN, &PatchPoint::N},       {kColNg, &PatchPoint::N},
    {kColNs, &PatchPoint::N},      {kColdNdu, &PatchPoint::dNdu}, {kColdNdv, &PatchPoint::dNdv}};

struct SingleRow {
    uint16_t column;
    float PatchPoint::*member;
};
constexpr SingleRow kSingles[] = {{kColU, &PatchPoint::u},    {kColS, &PatchPoint::u},
                                  {kColV, &PatchPoint::v},    {kColT, &PatchPoint::v},
                                  {kColDu, &PatchPoint::du},  {kColDv, &PatchPoint::dv},
                                  {kColRng, &PatchPoint::rng}};

// Frame-rate globals that are not 0.
struct FixedRow {
    Global id;
    float value;
};
constexpr FixedRow kFixed[] = {{Global::ncomps, 3}, {Global::alpha, 1}};

// A space's matrix in twelve columns, row by row.
void fill_space(const PointColumns& columns, size_t first, const dmat4& m) {
    for (int k = 0; k < 12; ++k)
        if (float* row = columns.rows[first + size_t(k)])
            std::fill_n(row, columns.count, float(m[k % 4][k / 4]));
}

}  // namespace

Patch::Patch(int width, int height, bool sphere) : width_(width), height_(height), sphere_(sphere) {
    dvec3 origin = sphere ? dvec3(0, 0, kSphereDistance) : dvec3(-0.5, -0.5, kSquareDistance);
    current_from_object_ = current_from_shader_ = glm::translate(dmat4(1.0), origin);
    points_.reserve(size_t(width) * size_t(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            uint32_t pixel = uint32_t(y) * uint32_t(width) + uint32_t(x);
            if (sphere)
                add_sphere_point(x, y, pixel);
            else
                add_square_point(x, y, pixel);
        }
}

void Patch::add_square_point(int x, int y, uint32_t pixel) {
    PatchPoint p;
    p.u = float((x + 0.5) / width_);
    p.v = float((height_ - y - 0.5) / height_);  // t = 0 is the bottom row
    p.P = vec3(current_from_object_ * dvec4(p.u, p.v, 0, 1));
    p.dPdu = vec3(1, 0, 0);
    p.dPdv = vec3(0, 1, 0);
    p.N = vec3(0, 0, -1);
    p.du = 1.0f / float(width_);
    p.dv = 1.0f / float(height_);
    p.rng = pixel_hash(pixel);
    p.pixel = pixel;
    points_.push_back(p);
}

// A ray from the eye through the pixel; pixels beside the sphere have no point.
void Patch::add_sphere_point(int x, int y, uint32_t pixel) {
    double d = kSphereDistance;
    double window = kSphereWindow / std::sqrt(d * d - 1.0);  // half of it, at z = 1
    double size = std::min(width_, height_);
    dvec3 ray((2 * (x + 0.5) - width_) / size * window, (height_ - 2 * (y + 0.5)) / size * window,
              1);
    double a = glm::dot(ray, ray), discriminant = d * d - a * (d * d - 1.0);
    if (discriminant <= 0) return;
    dvec3 P = ray * ((d - std::sqrt(discriminant)) / a);
    dvec3 N = P - dvec3(0, 0, d);
    double phi = std::asin(glm::clamp(N.y, -1.0, 1.0)), theta = std::atan2(N.x, -N.z);
    PatchPoint p;
    p.P = vec3(P);
    p.N = vec3(N);
    p.u = float(theta / (2 * kPi) + 0.5);
    p.v = float(phi / kPi + 0.5);
    // N = (cos phi sin theta, sin phi, -cos phi cos theta), differentiated.
    double cp = std::cos(phi), sp = std::sin(phi), ct = std::cos(theta), st = std::sin(theta);
    p.dNdu = vec3(dvec3(cp * ct, 0, cp * st) * (2 * kPi));
    p.dNdv = vec3(dvec3(-sp * st, cp, sp * ct) * kPi);
    p.dPdu = p.dNdu;
    p.dPdv = p.dNdv;
    double pixel_size = 2 * window / size * P.z;
    p.du = float(pixel_size / std::max(2 * kPi * cp, pixel_size));
    p.dv = float(pixel_size / kPi);
    p.rng = pixel_hash(pixel);
    p.pixel = pixel;
    points_.push_back(p);
}

void Patch::set_light(bool flip) {
    double z = current_from_object_[3].z - (sphere_ ? 2.0 : 1.0);
    current_from_shader_ = glm::translate(dmat4(1.0), dvec3(0, 0, z));
    if (flip) current_from_shader_ = glm::rotate(current_from_shader_, kPi, dvec3(0, 1, 0));
}

dmat4 Patch::current_from_space(std::string_view name) const {
    if (name == "current" || name == "camera") return dmat4(1.0);
    if (name == "shader") return current_from_shader_;
    // The square at its distance fills the picture: half its side over the distance, at z = 1.
    double half = 0.5 / kSquareDistance;
    dmat4 screen(0.0);
    screen[0][0] = screen[1][1] = 1.0 / half;
    screen[2][2] = kFar / (kFar - kNear);
    screen[3][2] = -kFar * kNear / (kFar - kNear);
    screen[2][3] = 1.0;
    if (name == "screen") return glm::inverse(screen);
    dmat4 ndc(1.0);  // 0..1 over the picture, y down
    ndc[0][0] = 0.5;
    ndc[1][1] = -0.5;
    ndc[3] = dvec4(0.5, 0.5, 0, 1);
    if (name == "NDC") return glm::inverse(ndc * screen);
    dmat4 raster(1.0);
    raster[0][0] = width_;
    raster[1][1] = height_;
    if (name == "raster") return glm::inverse(raster * ndc * screen);
    return current_from_object_;
}

void PatchPoints::fill(const PointColumns& columns) {
    auto fill = [&](size_t column, auto&& number) {
        if (float* row = columns.rows[column])
            for (size_t i = 0; i < columns.count; ++i) row[i] = number(patch_[first_ + i]);
    };
    for (size_t column = 0; column < columns.rows.size(); ++column)
        fill(column, [](const PatchPoint&) { return 0.0f; });
    for (const TripleRow& row : kTriples)
        for (int k = 0; k < 3; ++k)
            fill(row.first + size_t(k),
                 [&](const PatchPoint& point) { return (point.*row.member)[k]; });
    for (const SingleRow& row : kSingles)
        fill(row.column, [&](const PatchPoint& point) { return point.*row.member; });
    fill_space(columns, kColToCurrent, patch_.current_from_object());
    fill_space(columns, kColFromCurrent, glm::inverse(patch_.current_from_object()));
}

float frame_number(const Patch& patch, const KernelKey& key) {
    if (key.kind == KeyKind::CameraNear) return float(kNear);
    if (key.kind == KeyKind::CameraFar) return float(kFar);
    if (key.kind == KeyKind::Global)
        for (const FixedRow& row : kFixed)
            if (row.id == key.global()) return row.value;
    if (!key.is_space()) return 0;
    dmat4 m = patch.current_from_space(rsl::name_of(key));
    if (key.kind == KeyKind::SpaceFromCurrent) m = glm::inverse(m);
    return float(m[key.column()][key.row()]);
}

}  // namespace kinora
