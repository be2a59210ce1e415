// runtime/player/show_picture.cpp: from film to bytes, and what is drawn over them.
#include "runtime/player/show_picture.h"

#include "runtime/player/bytes/shown_bytes.h"
#include "runtime/player/picture/guide.h"
#include "runtime/player/pixel/draw_rays.h"

namespace kinora {

namespace {

// The film as bytes; of another size than the picture, it is enlarged on the way.
void show_film(const DisplaySettings& settings, raytrace::Film& enlarged, Picture& to) {
    const bool whole = to.film.width == to.width && to.film.height == to.height;
    if (!whole && is_plain(settings)) {
        const size_t row = 4 * size_t(to.width);
        to.rgba.resize(row * size_t(to.height));
        enlarge_rows(to.film, to.guide, to.width, to.height,
                     [&](int y, std::span<const vec4> pixels) {
                         shown_bytes(pixels, settings.encoding, &to.rgba[row * size_t(y)]);
                     });
        return show_kept(settings, to.width, to.height, to.rgba);
    }
    if (!whole) enlarge(to.film, to.guide, to.width, to.height, enlarged);
    display(whole ? to.film : enlarged, to.guide, to.costs, settings, to.rgba);
}

}  // namespace

void show_picture(DisplaySettings settings, raytrace::Film& enlarged, Picture& to) {
    const bool whole = to.film.width == to.width && to.film.height == to.height;
    if (!whole && !shows_guide(settings.aov) && !shows_costs(settings.aov))
        settings.aov.clear();  // planes come with all pixels
    show_film(settings, enlarged, to);
    to.numbers = number_scale(to.film, to.guide, to.costs, settings);
    if (settings.rays)
        draw_rays(settings.rays->rays, to.view, to.origin, to.width, to.height, to.rgba);
}

}  // namespace kinora
