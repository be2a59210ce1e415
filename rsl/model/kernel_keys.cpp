// rsl/model/kernel_keys.cpp: keys of kernel inputs and outputs, and their names.
#include "rsl/model/kernel_keys.h"

#include <algorithm>

#include "rsl/model/text_table.h"
#include "runtime/base/check.h"

namespace kinora::rsl {

namespace {

TextTable& names() {
    static TextTable& instance = *new TextTable;  // outlives every kernel
    return instance;
}

std::string suffix(const KernelKey& key) {
    switch (key.form) {
        case ComponentForm::Single:
            return "";
        case ComponentForm::Triple:
            return std::string(".") + "xyz"[key.component];
        case ComponentForm::Color:
            return std::string(".") + "rgb"[key.component];
        case ComponentForm::Matrix:
            return "." + std::to_string(key.component);
    }
    return "";
}

std::string element(const KernelKey& key) {
    return key.element < 0 ? "" : "[" + std::to_string(key.element) + "]";
}

const char* partial_text(Partial partial) {
    return partial == Partial::None ? "" : partial == Partial::Du ? "du" : "dv";
}

std::string global_text(const KernelKey& key) {
    std::string name(global_info(key.global()).name);
    return key.partial == Partial::None ? name : "d" + name + partial_text(key.partial);
}

std::string parameter_text(const KernelKey& key) {
    std::string result = "param:" + std::to_string(key.layer) + ":" + name_of(key);
    result += element(key) + suffix(key);
    return key.partial == Partial::None ? result : result + ":" + partial_text(key.partial);
}

std::string space_text(const KernelKey& key) {
    return "space:" + name_of(key) +
           (key.kind == KeyKind::SpaceToCurrent ? ":to_current:" : ":from_current:") +
           std::to_string(key.row()) + std::to_string(key.column());
}

std::string light_text(const KernelKey& key) {
    const char* column = key.light_column() == kLightL     ? "L"
                         : key.light_column() == kLightCl  ? "Cl"
                         : key.light_column() == kLightOl  ? "Ol"
                         : key.light_column() == kLightLit ? "lit"
                                                           : "spread";
    return "light:" + std::to_string(key.layer) + ":" + column + suffix(key);
}

}  // namespace

KernelKey global_key(Global id, int component) {
    return {.kind = KeyKind::Global,
            .form = form_of(global_info(id).type.base),
            .component = uint8_t(component),
            .name = int32_t(id)};
}

KernelKey parameter_key(uint32_t layer, std::string_view name, int element, ComponentForm form,
                        int component) {
    return {.kind = KeyKind::Parameter,
            .form = form,
            .component = uint8_t(component),
            .layer = layer,
            .name = name_id(name),
            .element = element};
}

KernelKey space_key(std::string_view space, bool to_current, int row, int column) {
    return {.kind = to_current ? KeyKind::SpaceToCurrent : KeyKind::SpaceFromCurrent,
            .component = uint8_t(row * 4 + column),
            .name = name_id(space)};
}

KernelKey light_key(size_t statement, LightColumn column, int component) {
    return {.kind = KeyKind::LightRecord,
            .form = column == kLightL                               ? ComponentForm::Triple
                    : column == kLightLit || column == kLightSpread ? ComponentForm::Single
                                                                    : ComponentForm::Color,
            .component = uint8_t(component),
            .layer = uint32_t(statement),
            .name = column};
}

KernelKey aov_key(std::string_view name, int element, ComponentForm form, int component) {
    return {.kind = KeyKind::Aov,
            .form = form,
            .component = uint8_t(component),
            .name = name_id(name),
            .element = element};
}

KernelKey message_key(std::string_view name, int element, ComponentForm form, int component) {
    KernelKey key = aov_key(name, element, form, component);
    key.kind = KeyKind::Message;
    return key;
}

// The slopes of P have names of their own; u and v are the coordinates themselves.
KernelKey partial_key(KernelKey key, Partial partial) {
    bool along_u = partial == Partial::Du;
    if (key.kind == KeyKind::Global) {
        if (key.global() == Global::P)
            return global_key(along_u ? Global::dPdu : Global::dPdv, key.component);
        if (key.global() == Global::u) return plain_key(along_u ? KeyKind::One : KeyKind::None);
        if (key.global() == Global::v) return plain_key(along_u ? KeyKind::None : KeyKind::One);
    }
    key.partial = partial;
    return key;
}

std::string text(const KernelKey& key) {
    switch (key.kind) {
        case KeyKind::None:
            return "";
        case KeyKind::Global:
            return global_text(key) + suffix(key);
        case KeyKind::One:
            return "1";
        case KeyKind::Rng:
            return "rng";
        case KeyKind::CameraNear:
            return "camera:near";
        case KeyKind::CameraFar:
            return "camera:far";
        case KeyKind::Parameter:
            return parameter_text(key);
        case KeyKind::SpaceToCurrent:
        case KeyKind::SpaceFromCurrent:
            return space_text(key);
        case KeyKind::LightRecord:
            return light_text(key);
        case KeyKind::Aov:
            return "aov:" + name_of(key) + element(key) + suffix(key);
        case KeyKind::Message:
            return "message:" + name_of(key) + element(key) + suffix(key);
    }
    return "";
}

int number_index(const KernelKey& key) {
    int width = key.form == ComponentForm::Single ? 1 : key.form == ComponentForm::Matrix ? 16 : 3;
    return std::max(key.element, 0) * width + key.component;
}

int32_t name_id(std::string_view name) {
    return names().id(name);
}

const std::string& name_of(const KernelKey& key) {
    CHECK(key.kind != KeyKind::Global && key.kind != KeyKind::LightRecord);
    return names().text(key.name);
}

}  // namespace kinora::rsl
