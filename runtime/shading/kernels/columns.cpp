// runtime/shading/kernels/columns.cpp: names of point-rate inputs to columns.
#include "runtime/shading/kernels/columns.h"

#include <string>

namespace kinora {

namespace {

struct Row {
    std::string_view name;
    uint16_t column;
    std::string_view suffixes;  // letters of the components, "" for a float
};
constexpr Row kRows[] = {
    {"P", kColP, "xyz"},       {"dPdu", kColdPdu, "xyz"}, {"dPdv", kColdPdv, "xyz"},
    {"N", kColN, "xyz"},       {"Ng", kColNg, "xyz"},     {"I", kColI, "xyz"},
    {"dNdu", kColdNdu, "xyz"}, {"dNdv", kColdNdv, "xyz"}, {"dIdu", kColdIdu, "xyz"},
    {"dIdv", kColdIdv, "xyz"}, {"Ps", kColPs, "xyz"},     {"Ns", kColNs, "xyz"},
    {"u", kColU, ""},          {"v", kColV, ""},          {"du", kColDu, ""},
    {"dv", kColDv, ""},        {"s", kColS, ""},          {"t", kColT, ""},
    {"dsdu", kColdsdu, ""},    {"dsdv", kColdsdv, ""},    {"dtdu", kColdtdu, ""},
    {"dtdv", kColdtdv, ""},    {"rng", kColRng, ""},      {"1", kColOne, ""},
    {"Ci", kColCi, "rgb"},     {"Oi", kColOi, "rgb"},     {"alpha", kColAlpha, ""},
};

uint16_t matrix_column(std::string_view name, std::string_view prefix, uint16_t first) {
    if (!name.starts_with(prefix) || name.size() != prefix.size() + 2) return kNoColumn;
    int row = name[prefix.size()] - '0', column = name[prefix.size() + 1] - '0';
    if (row < 0 || row > 2 || column < 0 || column > 3) return kNoColumn;
    return uint16_t(first + row * 4 + column);
}

}  // namespace

uint16_t find_column(std::string_view name) {
    for (const Row& row : kRows) {
        if (row.suffixes.empty() ? name == row.name
                                 : name.size() == row.name.size() + 2 &&
                                       name.starts_with(row.name) && name[row.name.size()] == '.') {
            if (row.suffixes.empty()) return row.column;
            size_t component = row.suffixes.find(name.back());
            if (component != std::string_view::npos) return uint16_t(row.column + component);
        }
    }
    for (std::string_view space : {"object", "shader"}) {
        for (bool to : {true, false}) {
            std::string prefix =
                "space:" + std::string(space) + (to ? ":to_current:" : ":from_current:");
            uint16_t column = matrix_column(name, prefix, to ? kColToCurrent : kColFromCurrent);
            if (column != kNoColumn) return column;
        }
    }
    return kNoColumn;
}

}  // namespace kinora
