// runtime/scene/gltf/curves/moving_object.h: a JSON object of a glTF file as a description's values
// move.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "runtime/scene/gltf/document/json.h"

namespace kinora {

// An object of the file for some values of the description. Members may come and go with them.
using ObjectAt = std::function<Json(const std::vector<double>& values)>;

// The object with all members that it has at any time. glTF's defaults stand for numbers that are
// missing at a time.
class MovingObject {
  public:
    explicit MovingObject(Json rest);
    ~MovingObject();
    MovingObject(MovingObject&&) noexcept;

    // What the object is at another time.
    void look_at(const Json& now);

    const Json& rest() const { return *rest_; }
    // JSON pointers from the object on: to numbers that are others at another time, and to those
    // that come and go without a default.
    const std::set<std::string>& moving() const { return moving_; }
    const std::set<std::string>& lost() const { return lost_; }

    // What a moving pointer's value is in the object at a time.
    std::vector<double> numbers(const Json& now, const std::string& pointer) const;

  private:
    void look_at(const Json& now, Json& rest, const std::string& pointer);
    void compare(const Json& now, Json& rest, const std::string& key, const std::string& pointer);

    std::unique_ptr<Json> rest_;
    std::set<std::string> moving_, lost_;
};

}  // namespace kinora
