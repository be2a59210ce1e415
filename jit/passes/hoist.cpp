// jit/passes/hoist.cpp: frame-rate work leaves the point kernel for the frame kernel.
//
// A walk back from what the point kernel does stops at every value of frame rate outside of loops:
// these become slots of the frame block, and nothing behind them is needed here any more. The
// frame kernel is a copy of the kernel that keeps what the slots need. All pure ops are total, so
// the copy takes values out of their Ifs and makes every Merge a Select. Functions that are called
// keep their work, but read frame inputs from slots.
#include <algorithm>

#include "jit/codegen/liveness_p.h"
#include "jit/ir/analysis.h"
#include "jit/ir/fold_inst.h"
#include "jit/ir/rewrite_p.h"
#include "jit/passes/passes.h"
#include "jit/passes/rates.h"

namespace kinora::jit {

namespace {

// Frame inputs [first, first + count) that point code indexes: a row of slots.
struct SlotRow {
    int32_t first;
    int32_t count;
    int32_t slot;
};

class Hoister {
  public:
    explicit Hoister(Module& module)
        : m_(module),
          frame_(module),
          effects_(has_effects(module)),
          rates_(infer_rates(module)),
          slot_of_(module.kernel().insts.size(), -1) {}

    Module run() {
        Liveness live(m_, m_.kernel(), effects_);
        for (Value v = 0; v < m_.kernel().insts.size(); ++v)
            if (may_be_slot(v)) live.cut(v);
        live.mark_effects();
        collect_slots(live);
        write_frame_kernel();
        write_point_kernel(live);
        return std::move(frame_);
    }

  private:
    bool may_be_slot(Value v) const {
        const Inst& inst = m_.kernel().insts[v];
        if (inst.type == Type::None || inst.op == Op::FrameLoad || is_constant(inst)) return false;
        return rates_.rate[v] != Rate::Point && !rates_.in_loop[v];
    }

    bool is_frame_gather(Value v) const {
        const Inst& inst = m_.kernel().insts[v];
        if (inst.op != Op::InputGather || may_be_slot(v)) return false;
        for (int32_t k = 0; k < inst.imm2; ++k)
            if (m_.inputs[static_cast<size_t>(inst.imm + k)].rate == Rate::Point) return false;
        return true;
    }

    void collect_slots(const Liveness& live) {
        next_slot_ = m_.frame_slots;
        for (Value v = 0; v < m_.kernel().insts.size(); ++v) {
            if (!live.is_live(v)) continue;
            const Inst& inst = m_.kernel().insts[v];
            if (is_frame_gather(v)) add_row(inst.imm, inst.imm2);
            if (!may_be_slot(v)) continue;
            slot_of_[v] = next_slot_++;
            slots_.push_back(v);
        }
        each_called([&](const Inst& inst) {
            if (int32_t count = frame_inputs(inst)) add_row(inst.imm, count);
        });
    }

    // The instructions of all functions but the kernel.
    template <class Each>
    void each_called(Each&& each) {
        for (Function& function : m_.functions)
            if (&function != &m_.kernel())
                for (Inst& inst : function.insts) each(inst);
    }
    // How many frame inputs the instruction reads; 0 if there is a point input among them.
    int32_t frame_inputs(const Inst& inst) const {
        int32_t count = inst.op == Op::Input ? 1 : inst.op == Op::InputGather ? inst.imm2 : 0;
        for (int32_t k = 0; k < count; ++k)
            if (input(inst.imm + k).rate == Rate::Point) return 0;
        return count;
    }

    void add_row(int32_t first, int32_t count) {
        if (find_row(first, count) != nullptr) return;
        rows_.push_back({first, count, next_slot_});
        next_slot_ += count;
    }
    const SlotRow* find_row(int32_t first, int32_t count) const {
        for (const SlotRow& row : rows_)
            if (row.first == first && row.count == count) return &row;
        return nullptr;
    }

    // Frame kernel: outputs in slot order.

    void write_frame_kernel() {
        Function& kernel = frame_.kernel();
        Liveness live(m_, m_.kernel(), effects_, Liveness::Around::LoopsOnly);
        for (Value v = 0; v < kernel.insts.size(); ++v)
            if (is_point(v)) live.cut(v);
        for (Value v : slots_) live.mark(v);
        frame_.name += ".frame";
        frame_.frame_slots = 0;
        std::vector<Value> outputs(static_cast<size_t>(next_slot_ - m_.frame_slots), kNone);
        Rewrite r(kernel);
        for (Value v = 0; v < r.old.size(); ++v)
            if (live.is_live(v) && r.old[v].op == Op::Input && !is_point(v)) r.copy(v);
        for (Value v = 0; v < r.old.size(); ++v) {
            bool done = r.old[v].op == Op::Input || r.old[v].op == Op::Return || is_point(v);
            if (live.is_live(v) && !done) copy_to_frame(r, v, live);
        }
        for (Value v : slots_) output(outputs, slot_of_[v]) = as_slot(r, r.renamed[v]);
        for (const SlotRow& row : rows_)
            for (int32_t k = 0; k < row.count; ++k)
                output(outputs, row.slot + k) = r.append(
                    {.op = Op::Input, .type = input(row.first).type, .imm = row.first + k});
        finish_frame(r, outputs);
    }

    // Only the mask of a pure call leads from what a slot needs to a value of point rate.
    bool is_point(Value v) const {
        return rates_.rate[v] == Rate::Point && m_.kernel().insts[v].type != Type::None;
    }

    Value& output(std::vector<Value>& outputs, int32_t slot) const {
        return outputs[static_cast<size_t>(slot - m_.frame_slots)];
    }
    const InputInfo& input(int32_t k) const { return m_.inputs[static_cast<size_t>(k)]; }

    void copy_to_frame(Rewrite& r, Value v, const Liveness& live) {
        const Inst& inst = r.old[v];
        switch (inst.op) {
            case Op::If:
            case Op::EndIf:
                return;
            case Op::Merge: {
                Value mask = r.renamed[r.old[static_cast<Value>(inst.imm)].a];
                r.renamed[v] = r.append({.op = Op::Select,
                                         .type = inst.type,
                                         .a = mask,
                                         .b = r.renamed[inst.a],
                                         .c = r.renamed[inst.b],
                                         .where = inst.where});
                return;
            }
            case Op::Call:
            case Op::Service:
                return copy_call(r, v);
            case Op::EndLoop:
                return copy_end_loop(r, v, live);
            default:
                r.copy(v);
        }
    }

    // A mask that a point decides is unknown here; the one lane asks without it.
    void copy_call(Rewrite& r, Value v) {
        Inst inst = r.old[v];
        if (rates_.rate[inst.a] == Rate::Point)
            inst.a = r.append({.op = Op::ConstM, .type = Type::M, .imm = 1});
        else
            inst.a = r.renamed[inst.a];
        r.set_renamed_args(inst, r.old_args_of(r.old[v]));
        r.renamed[v] = r.append(inst);
    }

    static void copy_end_loop(Rewrite& r, Value v, const Liveness& live) {
        Inst inst = r.translate(v);
        auto begin = static_cast<Value>(r.old[v].imm);
        std::vector<Value> next;
        std::span<const Value> old_next = r.old_args_of(r.old[v]);
        for (Value k = 0; k < old_next.size(); ++k)
            if (live.is_live(begin + 1 + k)) next.push_back(old_next[k]);
        r.set_renamed_args(inst, next);
        r.renamed[v] = r.append(inst);
    }

    // A mask crosses as an int.
    static Value as_slot(Rewrite& r, Value v) {
        if (r.function.insts[v].type != Type::M) return v;
        Value one = r.append({.op = Op::ConstI, .type = Type::I, .imm = 1});
        Value zero = r.append({.op = Op::ConstI, .type = Type::I, .imm = 0});
        return r.append({.op = Op::Select, .type = Type::I, .a = v, .b = one, .c = zero});
    }

    void finish_frame(Rewrite& r, const std::vector<Value>& outputs) {
        Function& kernel = frame_.kernel();
        frame_.outputs.clear();
        kernel.results.clear();
        Inst end{.op = Op::Return};
        end.args = static_cast<uint32_t>(kernel.args.size());
        end.arg_count = static_cast<uint16_t>(outputs.size());
        for (size_t k = 0; k < outputs.size(); ++k) {
            kernel.args.push_back(outputs[k]);
            Type type = kernel.insts[outputs[k]].type;
            kernel.results.push_back(type);
            frame_.outputs.push_back({"frame:" + std::to_string(k), type});
        }
        r.append(end);
    }

    // Point kernel: slots are loaded at the start, the rest of what is needed stays as it is.

    void write_point_kernel(const Liveness& live) {
        Function& kernel = m_.kernel();
        for (Inst& inst : kernel.insts) rewrite_gather(inst);
        load_slots(kernel, live);
        each_called([&](Inst& inst) {
            int32_t count = frame_inputs(inst);
            if (count == 0) return;
            inst.imm = find_row(inst.imm, count)->slot;
            inst.op = inst.op == Op::Input ? Op::FrameLoad : Op::FrameGather;
        });
        m_.frame_slots = next_slot_;
    }

    void rewrite_gather(Inst& inst) {
        if (inst.op != Op::InputGather) return;
        const SlotRow* row = find_row(inst.imm, inst.imm2);
        if (row == nullptr || input(inst.imm).rate == Rate::Point) return;
        inst.op = Op::FrameGather;
        inst.imm = row->slot;
    }

    void load_slots(Function& kernel, const Liveness& live) {
        std::vector<Type> types;
        for (Value v : slots_) types.push_back(kernel.insts[v].type);
        Rewrite r(kernel);
        for (size_t k = 0; k < slots_.size(); ++k)
            r.renamed[slots_[k]] = load(r, types[k], slot_of_[slots_[k]]);
        for (Value v = 0; v < r.old.size(); ++v) {
            if (!live.is_live(v) || slot_of_[v] >= 0) continue;
            if (r.old[v].op == Op::EndLoop)
                copy_end_loop(r, v, live);
            else
                r.copy(v);
        }
    }

    static Value load(Rewrite& r, Type type, int32_t slot) {
        if (type != Type::M) return r.append({.op = Op::FrameLoad, .type = type, .imm = slot});
        Value bits = r.append({.op = Op::FrameLoad, .type = Type::I, .imm = slot});
        Value one = r.append({.op = Op::ConstI, .type = Type::I, .imm = 1});
        return r.append({.op = Op::IEq, .type = Type::M, .a = bits, .b = one});
    }

    Module& m_;
    Module frame_;  // begins as a copy of the module
    std::vector<bool> effects_;
    Rates rates_;
    std::vector<int32_t> slot_of_;  // of each value, -1 = none
    std::vector<Value> slots_;
    std::vector<SlotRow> rows_;
    int32_t next_slot_ = 0;
};

}  // namespace

Module hoist(Module& module) {
    return Hoister(module).run();
}

}  // namespace kinora::jit
