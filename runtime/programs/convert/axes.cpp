// runtime/programs/convert/axes.cpp: --up and --unit: a document with other axes and another unit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <set>

#include "collada/document/edit.h"
#include "collada/document/write.h"
#include "runtime/base/numbers.h"
#include "runtime/programs/convert/axes_p.h"
#include "runtime/programs/convert/convert.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

using collada::Document;
using collada::Edit;
using collada::Element;

namespace {

template <class F>
void for_each_element(const Element& root, F&& f) {
    f(root);
    for (const Element& child : root.children()) for_each_element(child, f);
}

constexpr const char* kAxisNames[] = {"X_UP", "Y_UP", "Z_UP"};

// As collada's reader has it (COLLADA 1.4.1, chapter 5, up_axis).
dmat4 y_up_from(UpAxis up) {
    if (up == UpAxis::X) return dmat4({0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1});
    if (up == UpAxis::Z) return dmat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1});
    return dmat4(1.0);
}

// The edits that give a document other axes and another unit.
class AxisChange {
  public:
    // `own` is what the document was read with.
    AxisChange(const Document& document, Diagnostics& own, Diagnostics& diag)
        : document_(document), text_(own.files.text(document.file())), own_(own), diag_(diag) {}

    std::string run(std::optional<UpAxis> up_axis, std::optional<double> meter) {
        read_asset();
        UpAxis new_up = up_axis.value_or(old_up_);
        double new_meter = meter.value_or(old_meter_);
        write_asset(new_up, new_meter);
        scale_ = old_meter_ / new_meter;
        matrix_ = glm::transpose(y_up_from(new_up)) * y_up_from(old_up_);
        turns_ = new_up != old_up_;
        if (!turns_ && scale_ == 1) return collada::apply_edits(text_, edits_);
        for (int c = 0; c < 3; ++c) matrix_[c] = matrix_[c] * scale_;
        for_each_element(document_.root(), [this](const Element& e) { visit(e); });
        for (Edit& edit : change_skins(document_, matrix_, own_, diag_))
            edits_.push_back(std::move(edit));
        warn();
        return collada::apply_edits(text_, edits_);
    }

  private:
    static double take_number_or_0(std::string_view text) {
        return take_number<double>(text).value_or(0);
    }

    void read_asset() {
        asset_ = document_.root().child("asset");
        const Element* up = asset_ ? asset_->child("up_axis") : nullptr;
        const Element* unit = asset_ ? asset_->child("unit") : nullptr;
        for (size_t i = 0; up && i < 3; ++i)
            if (trimmed(up->text) == kAxisNames[i]) old_up_ = UpAxis(i);
        if (!unit || !unit->attribute("meter")) return;
        double meter = take_number_or_0(unit->value("meter"));
        if (meter > 0 && std::isfinite(meter)) old_meter_ = meter;
    }

    void write_asset(UpAxis up, double meter) {
        std::string unit = collada::shortest_number(meter);
        std::string unit_markup =
            with_prefix(fmt::format("<unit meter=\"{}\"{}/>", unit, unit_name(meter)));
        std::string up_markup =
            with_prefix(fmt::format("<up_axis>{}</up_axis>", kAxisNames[size_t(up)]));
        if (!asset_) {
            uint32_t at = document_.root().start_tag.end;
            edits_.push_back(
                {{at, at}, with_prefix("<asset>" + unit_markup + up_markup + "</asset>")});
            return;
        }
        // <unit> and <up_axis> stand at the end of <asset>, before the extras of 1.5.
        uint32_t end = uint32_t(text_.rfind("</", asset_->bytes.end - 1));
        if (const Element* extra = asset_->child("extra")) end = extra->bytes.begin;
        const Element* old_unit = asset_->child("unit");
        const Element* old_up = asset_->child("up_axis");
        if (asset_->bytes.end == asset_->start_tag.end) {
            edits_.push_back(collada::append_child(text_, *asset_, unit_markup + up_markup));
            return;
        }
        auto bytes_of = [&](const Element* old) {
            return old ? old->bytes : collada::ByteRange{end, end};
        };
        collada::ByteRange unit_bytes = bytes_of(old_unit);
        if (!old_unit && old_up) unit_bytes = {old_up->bytes.begin, old_up->bytes.begin};
        edits_.push_back({unit_bytes, unit_markup});
        edits_.push_back({bytes_of(old_up), up_markup});
    }

    static std::string unit_name(double meter) {
        static constexpr std::pair<double, const char*> kNames[] = {
            {1, "meter"},        {0.01, "centimeter"}, {0.001, "millimeter"},
            {1000, "kilometer"}, {0.0254, "inch"},     {0.3048, "foot"}};
        for (auto [value, name] : kNames)
            if (value == meter) return fmt::format(" name=\"{}\"", name);
        return "";
    }

    // Markup under the prefix that the document's elements have.
    std::string with_prefix(const std::string& markup) const {
        return collada::prefixed(markup, collada::prefix_of(text_, document_.root()));
    }

    void visit(const Element& e) {
        if (e.name == "visual_scene") wrap_nodes(e);
        if (e.name == "asset" && &e != asset_ && e.parent) change_inner_asset(e);
        has_rsl_ |= e.name == "profile_RSL";
        // An included file may say anything; code in the document says it here.
        knows_world_ |= (e.name == "code" && e.text.find("\"world\"") != e.text.npos) ||
                        (e.name == "include" && e.parent->name == "technique");
        if (std::string_view url = e.value("url"); url.find('#') != url.npos && url[0] != '#')
            external_ = external_ ? external_ : &e;
        // Lengths that no node's matrix reaches (it does reach the range a camera clips to).
        struct Row {
            std::string_view name;
            double power;
        };
        static constexpr Row kLengths[] = {
            {"xmag", 1}, {"ymag", 1}, {"linear_attenuation", -1}, {"quadratic_attenuation", -2}};
        if (scale_ == 1) return;
        for (const Row& row : kLengths) {
            if (e.name != row.name || !collada::holds_numbers(e)) continue;
            double value = take_number_or_0(e.text);
            edits_.push_back(replace_content(
                e, collada::shortest_number(value * std::pow(scale_, row.power)), text_));
            if (!e.value("sid").empty()) length_sids_.insert(std::string(e.value("sid")));
        }
    }

    // An <asset> inside: its unit keeps its ratio to the document's. No axes do so for all turns.
    void change_inner_asset(const Element& asset) {
        const Element* unit = asset.child("unit");
        double meter = unit ? take_number_or_0(unit->value("meter")) : 0.0;
        if (scale_ != 1 && unit && unit->attribute("meter") && meter > 0 && std::isfinite(meter)) {
            double changed = meter / scale_;
            edits_.push_back(
                {unit->bytes,
                 with_prefix(fmt::format("<unit meter=\"{}\"{}/>",
                                         collada::shortest_number(changed), unit_name(changed)))});
        }
        if (asset.child("up_axis") && turns_)
            diag_.report(Code::CONVERT_LOST, Location{}, fmt::format("<{}>", asset.parent->name),
                         "the <up_axis> of its own <asset>");
    }

    void wrap_nodes(const Element& scene) {
        const Element* first = scene.child("node");
        if (!first) return;
        const Element* last = first;
        for (const Element* e = first; e; e = e->next_named("node")) last = e;
        std::string id = "axes_and_unit";
        while (document_.find(id) || !made_ids_.insert(id).second) id += "_";
        edits_.push_back({{first->bytes.begin, first->bytes.begin},
                          with_prefix(fmt::format("<node id=\"{}\"><matrix>{}</matrix>", id,
                                                  rows_text(matrix_)))});
        edits_.push_back({{last->bytes.end, last->bytes.end}, with_prefix("</node>")});
    }

    void warn() {
        if (external_) diag_.report(Code::CONVERT_EXTERNAL, Location{}, external_->value("url"));
        if (has_rsl_ && scale_ != 1)
            diag_.report(Code::CONVERT_LOST, Location{}, "profile_RSL",
                         "lengths in world units inside shader code");
        if (knows_world_)
            diag_.report(Code::CONVERT_LOST, Location{}, "profile_RSL",
                         "places and directions in \"world\" space inside shader code");
        for_each_element(document_.root(), [this](const Element& e) {
            if (e.name != "channel") return;
            std::string_view target = e.value("target");
            std::string_view sid = target.substr(target.rfind('/') + 1);
            if (length_sids_.count(std::string(sid.substr(0, sid.find_first_of(".(")))))
                diag_.report(Code::CONVERT_LOST, Location{}, fmt::format("channel '{}'", target),
                             "an animated length");
        });
    }

    const Document& document_;
    std::string_view text_;
    Diagnostics& own_;
    Diagnostics& diag_;
    const Element* asset_ = nullptr;
    const Element* external_ = nullptr;
    UpAxis old_up_ = UpAxis::Y;
    double old_meter_ = 1;
    double scale_ = 1;  // old units in new ones
    dmat4 matrix_{1.0};
    bool has_rsl_ = false, knows_world_ = false, turns_ = false;
    std::set<std::string> length_sids_, made_ids_;
    std::vector<Edit> edits_;
};

}  // namespace

std::string change_axes(const std::string& path, const std::string& text,
                        std::optional<UpAxis> up_axis, std::optional<double> meter,
                        Diagnostics& diag) {
    Diagnostics quiet;
    std::optional<Document> document = collada::read_document_text(path, text, quiet);
    if (!document || !document->whole()) return text;
    return AxisChange(*document, quiet, diag).run(up_axis, meter);
}

}  // namespace kinora
