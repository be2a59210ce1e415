// runtime/picture/shading/frame/answer_tape.h: what lights and rays answered the kernel of a grid,
// for runs of it in some of the light.
#pragma once

#include <span>
#include <vector>

#include "jit/ir/kernel_call.h"
#include "rsl/model/services.h"
#include "runtime/base/arena.h"

namespace kinora {

class AnswerTape {
  public:
    struct Answer {
        rsl::Service service;
        int32_t first;                 // point of the call's lane 0
        const float* numbers;          // as ServiceCall::results; null: records
        int32_t handle = 0;            // of the records
        jit::RecordSet records = {};   // readable at the call's points
        const bool* colors = nullptr;  // by column of a record: light that rays found
    };

    // Forgets all.
    void start();
    void keep_numbers(rsl::Service service, const jit::ServiceCall& call, size_t rows);
    // Copies the records' uniforms and columns, since those of a lane group do not last in its
    // arena. Columns may be null. `colors`: by column, or none.
    void keep_records(rsl::Service service, const jit::ServiceCall& call, int32_t handle,
                      const jit::RecordSet& set, size_t uniforms, size_t columns,
                      std::span<const bool> colors);
    bool empty() const { return answers_.empty(); }

    // Before the kernel runs again.
    void rewind() { next_ = 0; }
    // The next answer of the service to the same points. Null: the kernel did not call then, or
    // more was answered than is kept.
    const Answer* find(rsl::Service service, const jit::ServiceCall& call);

  private:
    bool is_full() const;

    Arena arena_{1 << 20};
    std::vector<Answer> answers_;  // in the order of the calls
    size_t next_ = 0;
    size_t floats_ = 0;
};

}  // namespace kinora
