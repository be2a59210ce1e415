// collada/document/kml_p.h: the models of a .kml, and where on the earth they stand.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/base/math.h"

namespace kinora::collada {

// A <Model> (OGC KML 2.3, 12.7).
struct KmlModel {
    std::string name;  // its id, else the name of its <Placemark>
    std::string href;
    std::optional<double> longitude, latitude;  // degrees
    double altitude = 0;                        // metres above the ground, which is taken for level
    dvec3 orientation{0.0};                     // heading, tilt and roll, degrees
    dvec3 scale{1.0};
    std::vector<std::string> faults;  // "<x> is 'wide'": numbers that say nothing; left out

    bool has_place() const { return longitude && latitude; }
};

// Those that name a .dae, in the file's order; none where the file cannot be read. What such a file
// gets wrong beyond numbers is no finding: it is no COLLADA.
std::vector<KmlModel> read_kml(const std::string& path);

// The matrix from the model's metres (east, north, up) to those of `origin`. It only turns and
// scales where one of them has no place.
dmat4 kml_place(const KmlModel& model, const KmlModel& origin);

}  // namespace kinora::collada
