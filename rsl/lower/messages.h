// rsl/lower/messages.h: parameters of layers that are done, for displacement() and surface().
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rsl/lower/arrays.h"

namespace kinora::rsl {

class Messages {
  public:
    Messages(jit::Builder& builder, Arrays& arrays) : b_(builder), arrays_(arrays) {}

    struct Message {
        ShaderKind from;
        std::string name;
        Type type;
        Lowered value;
        int array = -1;    // index in Arrays
        size_t layer = 0;  // whose it was
    };
    using State = std::vector<Message>;

    void add(Message message) { list_.push_back(std::move(message)); }
    const std::vector<Message>& list() const { return list_; }
    // Null: the layer left none of that name.
    const Message* find(size_t layer, std::string_view name) const {
        for (const Message& message : list_)
            if (message.layer == layer && message.name == name) return &message;
        return nullptr;
    }
    // The elements of a message, plain numbers; one if it is no array.
    std::vector<Lowered> values(const Message& message) const {
        if (message.array < 0) return {message.value};
        std::vector<Lowered> result;
        for (int k = 0; k < message.type.array_length; ++k)
            result.push_back(arrays_.load(message.array, b_.i(k)));
        return result;
    }

    State enter_function() { return std::exchange(list_, {}); }
    void leave_function(State&& outer) { list_ = std::move(outer); }

  private:
    jit::Builder& b_;
    Arrays& arrays_;
    State list_;
};

}  // namespace kinora::rsl
