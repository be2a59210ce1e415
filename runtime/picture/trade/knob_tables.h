// runtime/picture/trade/knob_tables.h: the table of knobs as pages and programs read it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinora {

// What `kinora-render --knobs FORMAT` prints.
std::vector<std::string_view> knob_formats();  // "text", "json", "markdown", "presets"
std::string print_knobs(std::string_view format);

}  // namespace kinora
