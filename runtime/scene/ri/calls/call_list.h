// runtime/scene/ri/calls/call_list.h: calls that are kept.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "runtime/scene/ri/calls/call.h"

namespace kinora::ri {

// Calls with all that they point at, in their order.
class CallList {
  public:
    void add(const Call& call);
    // Views; they live as long as the list, and stay where they are when more are added.
    const std::vector<Call>& calls() const { return calls_; }
    bool empty() const { return calls_.empty(); }

  private:
    void* take(size_t count);
    void* store(const void* bytes, size_t count);
    std::string_view store_text(std::string_view text);
    Values store_values(const Values& values);

    std::vector<std::unique_ptr<std::byte[]>> blocks_;
    size_t left_ = 0;  // bytes at the end of the last block
    std::byte* next_ = nullptr;
    std::vector<Call> calls_;
};

}  // namespace kinora::ri
