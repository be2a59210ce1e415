// jit/codegen/held_record_p.h: which record general registers point at.
#pragma once

#include "jit/ir/ir.h"

namespace kinora::jit {

// The record read last stays in registers until control flow joins, a call may change them, or
// another record is read.
class HeldRecord {
  public:
    // Values, LoopOuts resolved: KernelArgs::record_sets[set].records[index].
    struct Key {
        Value set = kNone, index = kNone;
        bool operator==(const Key&) const = default;
    };

    const Key& key() const { return key_; }
    bool is(const Key& key) const { return key_ == key; }
    void hold(const Key& key) { key_ = key; }
    void drop() { key_.index = kNone; }

  private:
    Key key_;
};

}  // namespace kinora::jit
