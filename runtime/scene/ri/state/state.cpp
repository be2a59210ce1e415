// runtime/scene/ri/state/state.cpp: what several requests need of the graphics state.
#include "runtime/scene/ri/state/state.h"

#include <algorithm>
#include <cmath>

#include "runtime/scene/description/findings.h"

namespace kinora::ri {

void StateReport::not_done(std::string_view what, std::string_view why) {
    if (is_new(fmt::format("{} {}", what, why))) add(Code::RI_NOT_DONE, what, why);
}

std::string StateReport::folder_of(Location where) const {
    if (where.file == kNoFile) return "";
    const std::string& path = diagnostics_.files.name(where.file);
    return path.substr(0, path.rfind('/') + 1);
}

dvec3 rgb_of(const Values& values, const Options& options) {
    auto numbers = values.floats();
    dvec3 made(0.0);
    if (options.to_rgb.empty()) {
        for (size_t k = 0; k < 3 && !numbers.empty(); ++k)
            made[int(k)] = double(numbers[std::min(k, numbers.size() - 1)]);
    } else {
        for (size_t i = 0; i < numbers.size() && 3 * i + 2 < options.to_rgb.size(); ++i)
            for (size_t k = 0; k < 3; ++k)
                made[int(k)] += double(numbers[i]) * options.to_rgb[3 * i + k];
    }
    for (int k = 0; k < 3; ++k)
        if (!std::isfinite(made[k])) made[k] = 0;
    return made;
}

void keep_told(std::shared_ptr<const ToldValues>& told, const Call& call) {
    auto changed = told ? std::make_shared<ToldValues>(*told) : std::make_shared<ToldValues>();
    for (const Parameter& p : call.parameters) {
        ToldValue& value =
            (*changed)[fmt::format("{}:{}", call.arguments[0].string(), p.name)] = {};
        for (float number : p.values.floats()) value.numbers.push_back(double(number));
        for (int number : p.values.integers()) value.numbers.push_back(number);
        for (const char* text : p.values.strings()) value.strings.emplace_back(text);
    }
    told = std::move(changed);
}

}  // namespace kinora::ri
