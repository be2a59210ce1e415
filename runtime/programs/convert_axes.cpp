// runtime/programs/convert_axes.cpp: --up and --unit: a document with other axes and another unit.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/matrix.hpp>
#include <set>

#include "collada/edit.h"
#include "collada/write.h"
#include "runtime/findings.h"
#include "runtime/programs/convert.h"

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

std::string_view trimmed(std::string_view text) {
    size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
}

Edit replace_text(const Element& e, const std::string& text, std::string_view original) {
    uint32_t end = uint32_t(original.rfind("</", e.bytes.end - 1));
    return {{e.start_tag.end, end}, collada::escape_text(text)};
}

constexpr const char* kAxisNames[] = {"X_UP", "Y_UP", "Z_UP"};

// As collada's reader has it (COLLADA 1.4.1, chapter 5, up_axis).
dmat4 y_up_from(UpAxis up) {
    if (up == UpAxis::X) return dmat4({0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1});
    if (up == UpAxis::Z) return dmat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1});
    return dmat4(1.0);
}

// As COLLADA writes matrices: by rows.
std::string numbers_text(const dmat4& m) {
    std::string text;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
            text += (r || c ? " " : "") + collada::shortest_number(m[c][r] == 0 ? 0.0 : m[c][r]);
    return text;
}

dmat4 matrix_of(const double* rows) {
    dmat4 m;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) m[c][r] = rows[r * 4 + c];
    return m;
}

bool is_identity(const dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!(std::abs(m[c][r] - (c == r)) <= 1e-9)) return false;
    return true;
}

// Nothing where a word is no number.
std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    while (!(text = trimmed(text)).empty()) {
        text.remove_prefix(text[0] == '+');
        double value = 0;
        auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc()) return {};
        numbers.push_back(value);
        text.remove_prefix(size_t(stop - text.data()));
    }
    return numbers;
}

// The edits that give a document other axes and another unit.
class AxisChange {
  public:
    AxisChange(const Document& document, std::string_view text, Diagnostics& diag)
        : document_(document), text_(text), diag_(diag) {}

    std::string run(std::optional<UpAxis> up_axis, std::optional<double> meter) {
        read_asset();
        UpAxis new_up = up_axis.value_or(old_up_);
        double new_meter = meter.value_or(old_meter_);
        write_asset(new_up, new_meter);
        scale_ = old_meter_ / new_meter;
        matrix_ = glm::transpose(y_up_from(new_up)) * y_up_from(old_up_);
        if (new_up == old_up_ && scale_ == 1) return collada::apply_edits(text_, edits_);
        for (int c = 0; c < 3; ++c) matrix_[c] = matrix_[c] * scale_;
        for_each_element(document_.root(), [this](const Element& e) { visit(e); });
        warn();
        return collada::apply_edits(text_, edits_);
    }

  private:
    void read_asset() {
        asset_ = document_.root().child("asset");
        const Element* up = asset_ ? asset_->child("up_axis") : nullptr;
        const Element* unit = asset_ ? asset_->child("unit") : nullptr;
        for (size_t i = 0; up && i < 3; ++i)
            if (trimmed(up->text) == kAxisNames[i]) old_up_ = UpAxis(i);
        if (!unit || !unit->attribute("meter")) return;
        double meter = std::strtod(std::string(unit->value("meter")).c_str(), nullptr);
        if (meter > 0 && std::isfinite(meter)) old_meter_ = meter;
    }

    void write_asset(UpAxis up, double meter) {
        std::string unit = collada::shortest_number(meter);
        std::string unit_markup =
            own(fmt::format("<unit meter=\"{}\"{}/>", unit, unit_name(meter)));
        std::string up_markup = own(fmt::format("<up_axis>{}</up_axis>", kAxisNames[size_t(up)]));
        if (!asset_) {
            uint32_t at = document_.root().start_tag.end;
            edits_.push_back({{at, at}, own("<asset>" + unit_markup + up_markup + "</asset>")});
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
        auto place = [&](const Element* old) {
            return old ? old->bytes : collada::ByteRange{end, end};
        };
        collada::ByteRange unit_place = place(old_unit);
        if (!old_unit && old_up) unit_place = {old_up->bytes.begin, old_up->bytes.begin};
        edits_.push_back({unit_place, unit_markup});
        edits_.push_back({place(old_up), up_markup});
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
    std::string own(const std::string& markup) const {
        return collada::prefixed(markup, collada::prefix_of(text_, document_.root()));
    }

    void visit(const Element& e) {
        if (e.name == "visual_scene") return wrap_nodes(e);
        if (e.name == "skin") change_unjointed(e);
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
            double value = std::strtod(std::string(trimmed(e.text)).c_str(), nullptr);
            edits_.push_back(replace_text(
                e, collada::shortest_number(value * std::pow(scale_, row.power)), text_));
            if (!e.value("sid").empty()) length_sids_.insert(std::string(e.value("sid")));
        }
    }

    void wrap_nodes(const Element& scene) {
        const Element* first = scene.child("node");
        if (!first) return;
        const Element* last = first;
        for (const Element* e = first; e; e = e->next_named("node")) last = e;
        std::string id = "axes_and_unit";
        while (document_.find(id) || !made_ids_.insert(id).second) id += "_";
        edits_.push_back(
            {{first->bytes.begin, first->bytes.begin},
             own(fmt::format("<node id=\"{}\"><matrix>{}</matrix>", id, numbers_text(matrix_)))});
        edits_.push_back({{last->bytes.end, last->bytes.end}, own("</node>")});
    }

    // A vertex of joint -1 is placed by the bind shape alone, which no node reaches. For its skin
    // the change goes into the bind shape M B, and out of the joints' matrices again: (M J) (IBM
    // inverse(M)) (M B) = M (J IBM B).
    void change_unjointed(const Element& skin) {
        if (!names_no_joint(skin)) return;
        const Element* shape = skin.child("bind_shape_matrix");
        std::vector<double> bind_shape = shape ? numbers_of(shape->text) : std::vector<double>{};
        const Element* inverse_binds = inverse_bind_array(skin);
        std::vector<double> inverse =
            inverse_binds ? numbers_of(inverse_binds->text) : std::vector<double>{};
        // Without a bind shape the joints' places decide what the node does (skin_space.h).
        bool known = bind_shape.size() == 16 && !is_identity(matrix_of(bind_shape.data()));
        if (!known || inverse.empty() || inverse.size() % 16 != 0) {
            diag_.report(Code::CONVERT_LOST, Location{},
                         fmt::format("skin of '{}'", skin.parent->value("id")),
                         "the change of axes and unit for vertices of no joint");
            return;
        }
        edits_.push_back(
            replace_text(*shape, numbers_text(matrix_ * matrix_of(bind_shape.data())), text_));
        std::string text;
        for (size_t at = 0; at < inverse.size(); at += 16)
            text += (at ? " " : "") + numbers_text(matrix_of(&inverse[at]) * glm::inverse(matrix_));
        edits_.push_back(replace_text(*inverse_binds, text, text_));
    }

    // The numbers of INV_BIND_MATRIX, where they are this skin's own and lie one behind the other.
    const Element* inverse_bind_array(const Element& skin) const {
        const Element* joints = skin.child("joints");
        const Element* input = joints ? input_of(*joints, "INV_BIND_MATRIX") : nullptr;
        const Element* source = input ? target_of(input->value("source")) : nullptr;
        const Element* technique = source ? source->child("technique_common") : nullptr;
        const Element* accessor = technique ? technique->child("accessor") : nullptr;
        const Element* array = accessor ? target_of(accessor->value("source")) : nullptr;
        bool plain = array && source->parent == &skin && array->parent == source &&
                     accessor->value("stride") == "16" && !accessor->attribute("offset");
        return plain ? array : nullptr;
    }

    static const Element* input_of(const Element& parent, std::string_view semantic) {
        const Element* input = parent.child("input");
        while (input && input->value("semantic") != semantic) input = input->next_named("input");
        return input;
    }

    const Element* target_of(std::string_view url) const {
        return url.starts_with('#') ? document_.find(url.substr(1)) : nullptr;
    }

    static bool names_no_joint(const Element& skin) {
        const Element* weights = skin.child("vertex_weights");
        const Element* joint = weights ? input_of(*weights, "JOINT") : nullptr;
        const Element* v = weights ? weights->child("v") : nullptr;
        if (!joint || !v) return false;
        size_t stride = 1;
        for (const Element& input : weights->children())
            if (input.name == "input") stride = std::max(stride, offset_of(input) + 1);
        std::vector<double> indices = numbers_of(v->text);
        for (size_t i = offset_of(*joint); i < indices.size(); i += stride)
            if (indices[i] == -1) return true;
        return false;
    }

    static size_t offset_of(const Element& input) {
        std::vector<double> offset = numbers_of(input.value("offset"));
        return offset.size() == 1 && offset[0] >= 0 && offset[0] < 256 ? size_t(offset[0]) : 0;
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
    Diagnostics& diag_;
    const Element* asset_ = nullptr;
    const Element* external_ = nullptr;
    UpAxis old_up_ = UpAxis::Y;
    double old_meter_ = 1;
    double scale_ = 1;  // old units in new ones
    dmat4 matrix_{1.0};
    bool has_rsl_ = false, knows_world_ = false;
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
    std::string_view own = quiet.files.text(document->file());
    return AxisChange(*document, own, diag).run(up_axis, meter);
}

}  // namespace kinora
