// runtime/scene/load/override_environment.cpp: what lies around the scene, as options say.
#include "runtime/scene/load/override_environment.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/file_extension.h"
#include "runtime/base/numbers.h"
#include "runtime/base/regular_file.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/load/override_shader.h"

namespace kinora {

namespace {

bool names_shader(const std::string& what) {
    if (names_shader_file(what)) return lower_extension(what) == ".sl";
    return library_shader(what) != nullptr;
}

// A picture that the user names is read wherever it lies.
std::string picture_of(SceneDescription& description, const std::string& what) {
    const std::string path = parse_texture_name(what).path;
    if (!is_regular_file(path)) return what;
    description.pictures.add_file(path);
    return what;
}

// False after an error.
bool put_around(SceneDescription& description, const EnvironmentGiven& given,
                Diagnostics& diagnostics) {
    EnvironmentDefinition environment;
    if (const std::optional<dvec3> color = parse_environment_color(given.what)) {
        environment.color = *color;
    } else if (names_shader(given.what)) {
        environment.shader = find_environment_shader(
            description, {given.what, given.include_directories}, diagnostics);
        if (!environment.shader) return false;
    } else {
        environment.picture = picture_of(description, given.what);
    }
    description.environment = std::move(environment);
    return true;
}

}  // namespace

std::optional<dvec3> parse_environment_color(const std::string& text) {
    double c[3];
    if (!read_numbers<double>(text, ',', c) || !std::isfinite(c[0] + c[1] + c[2]))
        return std::nullopt;
    return dvec3(c[0], c[1], c[2]);
}

bool override_environment(SceneDescription& description, const EnvironmentGiven& given,
                          Diagnostics& diagnostics) {
    if (!given.any()) return true;
    if (given.what == "none") {
        description.environment.reset();
        return true;
    }
    if (!given.what.empty() && !put_around(description, given, diagnostics)) return false;
    if (!description.environment) {
        diagnostics.report(Code::ENVIRONMENT_NONE, Location{});
        return true;
    }
    EnvironmentDefinition& environment = *description.environment;
    environment.rotation = given.rotation.value_or(environment.rotation);
    environment.brightness = given.brightness.value_or(environment.brightness);
    if (given.hidden) environment.behind_picture = false;
    return true;
}

}  // namespace kinora
