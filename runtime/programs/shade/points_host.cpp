// runtime/programs/shade/points_host.cpp: answers to kernels that run over points of a file.
#include "runtime/programs/shade/points_host.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "rsl/model/renderer_services.h"
#include "runtime/programs/shade/points_lights.h"

namespace kinora {

namespace {

constexpr float kNothingHit = 1e30f;
constexpr int kRow = jit::kMaxLanes;
constexpr size_t kNoSet = 1, kFirstSet = 2, kSets = 64;

void fill_row(const jit::ServiceCall& call, int result, float value) {
    std::fill_n(call.results + result * kRow, kRow, value);
}

// What is known without the file: of a ray from the camera.
PointsValue number(double x) {
    return {{}, {x}, {}, true};
}
PointsValue text(const char* words) {
    return {{}, {}, {words}, true};
}
const PointsValues& known_of(rsl::QueryKind kind) {
    static const PointsValues ray = {
        {"type", text("camera")},      {"label", text("__camera")},
        {"depth", number(0)},          {"diffusedepth", number(0)},
        {"speculardepth", number(0)},  {"shadowdepth", number(0)},
        {"intent", text("shadegrid")}, {"shadingintent", text("shadegrid")}};
    static const PointsValues renderer = {{"renderer", text("Kinora")},
                                          {"versionstring", text(KINORA_VERSION)}};
    static const PointsValues none;
    return kind == rsl::QueryKind::RayInfo        ? ray
           : kind == rsl::QueryKind::RendererInfo ? renderer
                                                  : none;
}

const PointsValues& said_of(const PointsDocument& document, rsl::QueryKind kind) {
    static const PointsValues none;
    switch (kind) {
        case rsl::QueryKind::Attribute:
            return document.attributes;
        case rsl::QueryKind::Option:
            return document.options;
        case rsl::QueryKind::RendererInfo:
            return document.rendererinfo;
        case rsl::QueryKind::RayInfo:
            return document.rayinfo;
        default:
            return none;
    }
}

int32_t integer(const jit::ServiceCall& call, int row, int lane) {
    return jit::bits_of(call.args[row * kRow + lane]);
}

// The numbers of one element, the id of a text; empty where the value is of another type or length.
std::vector<float> answer(const PointsValue& value, char type, int element, int length) {
    bool is_text = type == 's';
    size_t width = is_text || type == 'f' ? 1 : type == 'm' ? 16 : 3;
    bool lengths =
        is_text == value.is_text() && value.size() % width == 0 && !value.lengths.empty();
    if (element == rsl::kQueryLength)
        return lengths ? std::vector<float>{float(value.size() / width)} : std::vector<float>();
    size_t elements = element < 0 ? 1 : size_t(std::max(length, 1));
    size_t at = element < 0 ? 0 : size_t(element);
    if (is_text != value.is_text() || value.size() != elements * width || at >= elements) return {};
    if (is_text) return {jit::float_of(rsl::intern(value.texts[at]))};
    auto first = value.numbers.begin() + std::ptrdiff_t(at * width);
    return {first, first + std::ptrdiff_t(width)};
}

std::optional<PointsValue> found_in(std::initializer_list<const PointsValues*> tables,
                                    const std::string& name) {
    for (const PointsValues* table : tables)
        if (auto found = table->find(name); found != table->end()) return found->second;
    return std::nullopt;
}

}  // namespace

PointsHost::PointsHost(const PointSet& points, TextureStore& textures, PointsLights* lights)
    : points_(points), textures_(textures), lights_(lights), sets_(kSets) {}

std::span<const jit::RecordSet> PointsHost::at_points(Arena& arena) {
    arena_ = &arena;
    if (lights_) sets_[0] = lights_->at_points(points_, *this, arena);
    next_set_ = kFirstSet;
    return sets_;
}

dmat4 PointsHost::current_from_space(std::string_view name, size_t) const {
    return name == "shader" ? shader_space_ : points_.current_from_space(name);
}
dmat4 PointsHost::world_from_current() const {
    return glm::inverse(points_.current_from_space("world"));
}

void PointsHost::print(const jit::ServiceCall& call) {
    for (int lane = 0; lane < call.lanes; ++lane)
        if (call.mask >> lane & 1) printed_.add(call, lane);
}

// Lights at other positions. Records stay until the next group of lanes asks.
void PointsHost::lights(const jit::ServiceCall& call) {
    if (group_ != call.first) {
        local_.reset();
        next_set_ = kFirstSet;
        group_ = call.first;
    }
    size_t set = kNoSet;
    if (lights_) {
        set = next_set_;
        next_set_ = next_set_ + 1 < kSets ? next_set_ + 1 : kFirstSet;
        sets_[set] = lights_->at_lanes(points_, call, *this, local_);
    }
    fill_row(call, 0, jit::float_of(int32_t(set)));
}

void PointsHost::trace(const jit::ServiceCall& call) {
    for (int k = 0; k < 3; ++k) fill_row(call, k, 0.0f);
    fill_row(call, 3, kNothingHit);
}
void PointsHost::transmission(const jit::ServiceCall& call) {
    for (int k = 0; k < 3; ++k) fill_row(call, k, 1.0f);
}
void PointsHost::gather(const jit::ServiceCall& call) {
    fill_row(call, 0, jit::float_of(int32_t(kNoSet)));
}

void PointsHost::query(const jit::ServiceCall& call) {
    for (int lane = 0; lane < kRow; ++lane) {
        call.results[lane] = jit::float_of(0);
        if (!(call.mask >> lane & 1)) continue;
        rsl::QueryKind kind = rsl::QueryKind(integer(call, 0, lane));
        const std::string& name = rsl::interned(integer(call, 1, lane));
        const std::optional<PointsValue> value =
            kind == rsl::QueryKind::Light
                ? (lights_ ? lights_->parameter(integer(call, 5, lane), name) : std::nullopt)
                : found_in({&said_of(points_.document(), kind), &known_of(kind)}, name);
        if (!value) continue;
        std::vector<float> numbers = answer(*value, char(integer(call, 2, lane)),
                                            integer(call, 3, lane), integer(call, 4, lane));
        call.results[lane] = jit::float_of(int32_t(!numbers.empty()));
        for (size_t k = 0; k < numbers.size(); ++k)
            call.results[(1 + k) * kRow + size_t(lane)] = numbers[k];
    }
}

}  // namespace kinora
