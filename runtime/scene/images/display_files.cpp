// runtime/scene/images/display_files.cpp: names of displays' files, and what is in them.
#include "runtime/scene/images/display_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <string_view>

#include "runtime/base/file_extension.h"
#include "runtime/base/files/temporary_file.h"

namespace kinora {
namespace {

constexpr const char* kUnnamed = "ri";

Quantization quantization_of(const FileDisplay& display) {
    return display.quantization.value_or(Quantization());
}

bool is_exr(const FileDisplay& display) {
    const DisplayContent content = content_of(display);
    const Quantization q = quantization_of(display);
    const bool bytes = q.is_whole() && q.low >= 0 && q.high <= 255;
    return has_extension(display.name, {".exr"}) || display.type == "exr" ||
           display.type == "openexr" || !bytes || (content.depth && content.is_picture());
}

std::string without_suffix(const std::string& name) {
    const bool known =
        has_extension(name, {".png", ".exr", ".tif", ".tiff", ".jpg", ".jpeg", ".gif",  ".bmp",
                             ".tga", ".rgb", ".sgi", ".pic",  ".pix", ".rla",  ".iff",  ".ppm",
                             ".pnm", ".cin", ".dpx", ".hdr",  ".it",  ".tx",   ".zfile"});
    return known ? name.substr(0, name.rfind('.')) : name;
}

// The last part of a path; what names no file of its own gives the usual name.
std::string base_name(const std::string& name) {
    std::string base = name.substr(name.find_last_of("/\\") + 1);
    return base.empty() || base == "." || base == ".." ? kUnnamed : base;
}

// Letters and digits of a mode, for a name.
std::string mode_name(const FileDisplay& display) {
    const DisplayContent content = content_of(display);
    std::string name = content.variable.empty() ? display.mode : content.variable;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

std::string with_mode(const std::string& path, const FileDisplay& display) {
    const size_t suffix = path.rfind('.');
    return path.substr(0, suffix) + "." + mode_name(display) + path.substr(suffix);
}

// What two displays of one file may not differ in.
std::string shown_by(const FileDisplay& display) {
    const DisplayContent content = content_of(display);
    return content.color && !content.depth ? "colors" : mode_name(display);
}

bool is_screen(const FileDisplay& display) {
    return display.type == "framebuffer" || display.type == "it" || display.type == "window";
}

// Gives each display its file, and leaves out those that show what another one does.
class Files {
  public:
    using Naming = std::function<std::string(const FileDisplay&)>;

    explicit Files(Naming path_of) : path_of_(std::move(path_of)) {}

    void add(const FileDisplay& display) {
        const std::string shown = shown_by(display);
        const bool again = !known_.insert({display.name, shown}).second;
        if (again || (is_screen(display) && shown == "colors" && has_colors_)) return;
        has_colors_ |= shown == "colors";
        std::string path = path_of_(display);
        if (!paths_.insert(path).second) path = with_mode(path, display);
        paths_.insert(path);
        made_.push_back({display, std::move(path)});
    }
    // The file of the first display of colours.
    void take_picture(const std::string& path, const FileDisplay* display) {
        paths_.insert(path);
        if (display) known_.insert({display->name, shown_by(*display)});
        has_colors_ = true;
    }
    std::vector<DisplayFile> take() { return std::move(made_); }

  private:
    Naming path_of_;
    std::vector<DisplayFile> made_;
    std::set<std::pair<std::string, std::string>> known_;  // name and shown_by()
    std::set<std::string> paths_;
    bool has_colors_ = false;
};

// The planes of an output: its own, or one a component or an element.
std::vector<const raytrace::AovPlane*> planes_of(const raytrace::Film& film,
                                                 const std::string& output) {
    std::vector<const raytrace::AovPlane*> planes;
    for (const raytrace::AovPlane& plane : film.aovs)
        if (plane.name == output || plane.name.starts_with(output + ".")) planes.push_back(&plane);
    return planes;
}

void expose(raytrace::Film& film, const Exposure& before, const Exposure& wanted) {
    const double gain = before.gain > 0 ? wanted.gain / before.gain : 0;
    for (vec4& pixel : film.rgba)
        for (int c = 0; c < 3; ++c) {
            const double shone = std::pow(std::max(double(pixel[c]), 0.0), before.gamma);
            pixel[c] = float(std::pow(gain * shone, 1 / wanted.gamma));
        }
}

// Numbers of up to three planes as colours, one as grey.
void show_planes(const std::vector<const raytrace::AovPlane*>& planes, raytrace::Film& to) {
    for (size_t i = 0; i < to.rgba.size(); ++i) {
        auto value = [&](size_t c) {
            return planes.size() == 1  ? planes[0]->values[i]
                   : c < planes.size() ? planes[c]->values[i]
                                       : 0.0f;
        };
        to.rgba[i] = vec4(value(0), value(1), value(2), 1);
    }
    if (planes.size() > 3)
        for (const raytrace::AovPlane* plane : planes) to.aovs.push_back(*plane);
    for (raytrace::AovPlane& plane : to.aovs) plane.in_file = true;
}

raytrace::Film shown_film(const FileDisplay& display, const Exposure& exposed,
                          const raytrace::Film& film) {
    const DisplayContent content = content_of(display);
    raytrace::Film shown;
    shown.width = film.width, shown.height = film.height;
    shown.rgba = film.rgba;
    if (content.is_picture()) {
        for (vec4& pixel : shown.rgba) {
            if (!content.color) pixel = vec4(pixel.w, pixel.w, pixel.w, 1);
            if (!content.alpha) pixel.w = 1;
        }
        if (content.color && display.exposure) expose(shown, exposed, *display.exposure);
    } else {
        show_planes(planes_of(film, content.depth ? "z" : content.variable), shown);
        if (display.exposure) expose(shown, Exposure(), *display.exposure);
    }
    if (content.depth) {
        shown.aovs.push_back(*planes_of(film, "z")[0]);
        shown.aovs.back().name = "Z";  // as OpenEXR calls it
        shown.aovs.back().in_file = true;
    }
    return shown;
}

uint8_t quantised(double value, const Quantization& q) {
    const double made = std::floor(q.zero + value * (q.one - q.zero) + 0.5);
    return uint8_t(std::isnan(made) ? q.low : std::clamp(made, q.low, q.high));
}

Image8 quantised(const raytrace::Film& film, const Quantization& q, bool has_alpha) {
    Image8 image{film.width, film.height, std::vector<uint8_t>(film.rgba.size() * 4)};
    for (size_t i = 0; i < film.rgba.size(); ++i) {
        const vec4& p = film.rgba[i];
        const double scale = has_alpha && p.w > 0 ? 1 / double(p.w) : 1;  // PNG's is unassociated
        for (int c = 0; c < 3; ++c)
            image.rgba[4 * i + size_t(c)] = quantised(scale * double(p[c]), q);
        image.rgba[4 * i + 3] = has_alpha ? quantised(double(p.w), q) : 255;
    }
    return image;
}

bool is_usual(const Quantization& q) {
    return q.zero == 0 && q.one == 255 && q.low == 0 && q.high == 255;
}

}  // namespace

std::string file_of(const FileDisplay& display) {
    const std::string name = display.name.empty() ? kUnnamed : display.name;
    return without_suffix(name) + (is_exr(display) ? ".exr" : ".png");
}

std::vector<DisplayFile> display_files(std::span<const FileDisplay> displays) {
    Files files(file_of);
    for (const FileDisplay& display : displays) files.add(display);
    return files.take();
}

std::string display_stem(const FileDisplay& display) {
    return without_suffix(base_name(display.name));
}

std::vector<DisplayFile> displays_beside(const std::string& picture,
                                         std::span<const FileDisplay> displays,
                                         const NumberedDisplays& numbered) {
    const std::string folder = picture.substr(0, picture.rfind('/') + 1);
    Files files([&](const FileDisplay& display) {
        const std::string stem = display_stem(display);
        const bool has_number = !numbered.number.empty() && numbered.stems.contains(stem);
        return folder + stem + (has_number ? "." + numbered.number : "") +
               (is_exr(display) ? ".exr" : ".png");
    });
    auto first = std::ranges::find_if(
        displays, [](const FileDisplay& display) { return content_of(display).color; });
    files.take_picture(picture, first == displays.end() ? nullptr : &*first);
    for (auto display = displays.begin(); display != displays.end(); ++display)
        if (display != first) files.add(*display);
    return files.take();
}

bool has_outputs(const FileDisplay& display, FunctionRef<bool(const std::string&)> is_there) {
    const DisplayContent content = content_of(display);
    return (!content.depth || is_there("z")) &&
           (content.variable.empty() || is_there(content.variable));
}

std::string write_display(const DisplayFile& file, const Exposure& exposed,
                          const raytrace::Film& film, ColorEncoding encoding,
                          const ImageTexts& texts, int* errno_out) {
    if (const int number = make_folder_of(file.path)) {
        if (errno_out) *errno_out = number;
        return std::strerror(number);
    }
    const DisplayContent content = content_of(file.display);
    const Quantization q = quantization_of(file.display);
    const raytrace::Film shown = shown_film(file.display, exposed, film);
    const bool colors = content.color && !content.depth;
    if (has_extension(file.path, {".exr"}))
        return write_image(file.path, shown, ColorEncoding::Linear, texts, errno_out,
                           colors && q.is_whole() ? PictureDepth::Half : PictureDepth::Float);
    if (colors && is_usual(q))
        return write_png(file.path, to_8_bit(shown, encoding), texts, errno_out);
    return write_png(file.path, quantised(shown, q, content.color && content.alpha), texts,
                     errno_out);
}

}  // namespace kinora
