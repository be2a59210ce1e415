// collada/extract/environment.cpp: what lies around a visual scene:
// <extra><technique profile="RSL"><environment>.
#include <algorithm>
#include <utility>

#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

struct Part {
    Extraction& x;
    Link link;
    Environment& to;

    // False after a finding, and what the element says is left out.
    bool wrong(std::string_view why) const {
        x.diag.report(Code::RSL_ENVIRONMENT, x.where(link),
                      fmt::format("<{}> {}", link.element->name, why));
        return false;
    }
};

bool read_picture(const Part& part) {
    if (Link target = resolve(part.x, part.link, "url", {"image"}))
        part.to.image = image_index(part.x, target);
    return part.to.image != kNone;
}

bool read_color(const Part& part) {
    NumberFaults faults;
    const std::vector<double> numbers = scan_doubles(part.link.element->text, 3, faults);
    const bool sound = !faults.number.length && !faults.nonfinite.length;
    if (numbers.size() != 3 || !sound) return part.wrong("is no color of three numbers");
    std::copy_n(numbers.begin(), 3, part.to.color.begin());
    return true;
}

bool read_number(const Part& part, double least, double& to) {
    double number = 0;
    if (!parse_double(part.link.element->text, number)) return part.wrong("is no number");
    if (number < least) return part.wrong("is below 0");
    to = number;
    return true;
}

bool read_rotation(const Part& part) {
    return read_number(part, -1e30, part.to.rotation);
}
bool read_brightness(const Part& part) {
    return read_number(part, 0, part.to.brightness);
}

bool read_hidden(const Part& part) {
    const std::optional<bool> hidden = parse_bool(part.link.element->text);
    if (!hidden) return part.wrong("is neither true nor false");
    part.to.hidden = *hidden;
    return true;
}

struct PartRow {
    std::string_view name;
    bool (*read)(const Part& part);
    bool is_light;  // what rays that leave the scene see
};
constexpr PartRow kParts[] = {{"instance_image", read_picture, true},
                              {"color", read_color, true},
                              {"rotation", read_rotation, false},
                              {"brightness", read_brightness, false},
                              {"hidden", read_hidden, false}};

// Nothing where neither a picture nor a color stands: no light would come from there.
std::optional<Environment> read_parts(Extraction& x, Link link) {
    Environment environment;
    environment.where = x.where(link);
    bool seen[std::size(kParts)] = {}, lights = false;
    for (const Element& child : link.element->children()) {
        const Part part{x, {link.doc, &child}, environment};
        const auto* row = std::ranges::find(kParts, child.name, &PartRow::name);
        if (row == std::end(kParts)) {
            part.wrong("is not known here");
        } else if (std::exchange(seen[row - kParts], true)) {
            part.wrong("stands here twice; the first counts");
        } else {
            const bool read = row->read(part);
            lights |= read && row->is_light;
        }
    }
    if (lights) return environment;
    x.diag.report(Code::RSL_ENVIRONMENT, environment.where,
                  "it has neither an <instance_image> nor a <color>");
    return std::nullopt;
}

}  // namespace

void read_environment(Extraction& x, Link scene) {
    for (const Element& extra : scene.element->children())
        for (const Element& technique : extra.children()) {
            if (extra.name != "extra" || technique.value("profile") != "RSL") continue;
            const Element* found = technique.child("environment");
            if (found && !x.scene.environment)
                x.scene.environment = read_parts(x, {scene.doc, found});
        }
}

}  // namespace kinora::collada
