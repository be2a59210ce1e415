// runtime/kinora/aov_texts.cpp: filters of AOVs, and names of numbers.
#include "runtime/kinora/aov_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/scene/aovs/cryptomatte.h"
#include "runtime/scene/names.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

using Json = nlohmann::ordered_json;

std::string names_text(const std::vector<IdName>& names) {
    Json json = Json::object();
    for (const IdName& row : names) json[std::to_string(row.id)] = row.name;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string filter_text(const OutputPlane& plane) {
    return fmt::format(R"({{"filter":"{}","premultiplied":{},"background":{:g}}})",
                       word_of(plane.filter), plane.filter == raytrace::AovFilter::Mean,
                       plane.background);
}

struct NamesOf {
    AovSource source;
    std::vector<IdName> (*names)(const SceneNodes&, const SceneShapes&);
};
constexpr NamesOf kNames[] = {
    {AovSource::Surface, surface_names},
    {AovSource::Object, object_names},
    {AovSource::Material, material_names},
};

struct CryptoOf {
    AovSource source;
    std::vector<IdName> (*names)(const SceneNodes&, const SceneShapes&);
};
constexpr CryptoOf kCryptos[] = {
    {AovSource::CryptoObject, object_names},
    {AovSource::CryptoMaterial, material_names},
};

void add_crypto(const Scene& scene, const OutputPlane& plane,
                std::vector<std::pair<std::string, std::string>>& texts) {
    const auto* row = std::ranges::find(kCryptos, plane.source, &CryptoOf::source);
    if (row == std::end(kCryptos)) return;
    std::vector<std::string> names;
    for (IdName& name : row->names(scene, scene)) names.push_back(std::move(name.name));
    for (auto& text : crypto_texts(plane.layer, names)) texts.push_back(std::move(text));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> aov_texts(const Scene& scene) {
    std::vector<std::pair<std::string, std::string>> texts;
    std::set<std::string> seen;
    for (const OutputPlane& plane : scene.outputs) {
        if (!plane.in_file || !seen.insert(plane.layer).second) continue;
        texts.emplace_back("kinora/aov/" + plane.layer, filter_text(plane));
        for (const NamesOf& row : kNames)
            if (row.source == plane.source)
                texts.emplace_back("kinora/" + plane.layer, names_text(row.names(scene, scene)));
        add_crypto(scene, plane, texts);
    }
    return texts;
}

}  // namespace kinora
