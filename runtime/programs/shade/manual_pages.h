// runtime/programs/shade/manual_pages.h: the pages of docs, or parts of them, that are drawn from
// the tables of the language. scripts/docs writes them to where they belong.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinora {

std::vector<std::string_view> manual_pages();    // "builtins", "globals", ...
std::string manual_page(std::string_view name);  // Markdown; "" for a name that is none

}  // namespace kinora
