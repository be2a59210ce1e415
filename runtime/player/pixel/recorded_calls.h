// runtime/player/pixel/recorded_calls.h: what services answered a kernel at one point.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "rsl/reference/reference.h"

namespace kinora {

// Numbers as the reference has them: ints and ids as numbers.
struct RecordedCall {
    rsl::Service service;
    std::vector<double> arguments, results;
    bool used = false;
};

// Finds for a question of the reference the call that the kernel made.
class RecordedCalls {
  public:
    // Asks the service itself; nothing where that shoots rays.
    using Live = std::function<std::vector<double>(rsl::Service, std::span<const double>)>;
    explicit RecordedCalls(Live live) : live_(std::move(live)) {}

    void add(RecordedCall call) { calls_.push_back(std::move(call)); }
    // The nearest recorded call, in the order of the kernel's where several are as near. Calls that
    // the kernel did without (in its frame kernel, or for a slope that nobody reads) are made now.
    std::vector<double> answer(rsl::Service service, std::span<const double> arguments);
    void begin_run();  // no call was used yet
    // Services that shoot rays and were asked what the kernel did not ask them.
    const std::set<std::string>& unanswered() const { return unanswered_; }

  private:
    std::vector<RecordedCall> calls_;
    Live live_;
    std::set<std::string> unanswered_;
};

}  // namespace kinora
