// runtime/scene/gltf/curves/moving_object.cpp: a JSON object of a glTF file as a description's
// values move.
#include "runtime/scene/gltf/curves/moving_object.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace kinora {

namespace {

// glTF's defaults of numbers that our writers leave out, by the end of their pointers.
struct DefaultRow {
    const char* pointer;
    std::vector<double> numbers;
    bool is_list;
};
const DefaultRow kDefaults[] = {
    {"/emissiveFactor", {0, 0, 0}, true},
    {"/KHR_materials_emissive_strength/emissiveStrength", {1}, false},
    {"/KHR_materials_specular/specularFactor", {1}, false},
    {"/KHR_materials_specular/specularColorFactor", {1, 1, 1}, true},
    {"/KHR_materials_ior/ior", {1.5}, false},
    {"/KHR_texture_transform/offset", {0, 0}, true},
    {"/KHR_texture_transform/rotation", {0}, false},
    {"/KHR_texture_transform/scale", {1, 1}, true},
    {"/color", {1, 1, 1}, true},  // of lights
};

// Null where there is none.
const DefaultRow* default_of(const std::string& pointer) {
    for (const DefaultRow& row : kDefaults)
        if (pointer.ends_with(row.pointer)) return &row;
    return nullptr;
}

bool is_numbers(const Json& value) {
    return value.is_number() ||
           (value.is_array() && !value.empty() &&
            std::ranges::all_of(value, [](const Json& item) { return item.is_number(); }));
}

}  // namespace

MovingObject::MovingObject(Json rest) : rest_(std::make_unique<Json>(std::move(rest))) {}
MovingObject::~MovingObject() = default;
MovingObject::MovingObject(MovingObject&&) noexcept = default;

void MovingObject::look_at(const Json& now) {
    look_at(now, *rest_, "");
}

void MovingObject::look_at(const Json& now, Json& rest, const std::string& pointer) {
    std::set<std::string> keys;
    for (const Json* object : {&now, static_cast<const Json*>(&rest)})
        for (const auto& item : object->items()) keys.insert(item.key());
    for (const std::string& key : keys) compare(now, rest, key, pointer + "/" + key);
}

// One member of both.
void MovingObject::compare(const Json& now, Json& rest, const std::string& key,
                           const std::string& pointer) {
    const bool is_now = now.contains(key), was = rest.contains(key);
    const Json& known = is_now ? now.at(key) : rest.at(key);
    if (known.is_object()) {
        if (!was) rest[key] = Json::object();
        return look_at(is_now ? known : Json::object(), rest[key], pointer);
    }
    if (!was && !is_numbers(known)) rest[key] = known;
    if (!is_numbers(known) || (is_now && was && now.at(key) == rest.at(key))) return;
    const DefaultRow* otherwise = default_of(pointer);
    if (!(is_now && was) && !otherwise) {
        lost_.insert(pointer);
        return;
    }
    if (!was)
        rest[key] = otherwise->is_list ? Json(otherwise->numbers) : Json(otherwise->numbers[0]);
    moving_.insert(pointer);
}

std::vector<double> MovingObject::numbers(const Json& now, const std::string& pointer) const {
    Json::json_pointer path(pointer);
    if (!now.contains(path)) return default_of(pointer)->numbers;
    const Json& value = now.at(path);
    return value.is_number() ? std::vector<double>{value.get<double>()}
                             : value.get<std::vector<double>>();
}

}  // namespace kinora
