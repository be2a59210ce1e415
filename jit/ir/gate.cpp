// jit/ir/gate.cpp: what only products with zero factors need is moved to the end, into an If.
//
// The kernel's top level is a row of items: a single instruction, a call with its Results, a whole
// region with what follows it. Items that something else needs are early and stay; the rest is
// late.
#include "jit/ir/gate.h"

#include <algorithm>

#include "jit/ir/analysis.h"
#include "jit/ir/rewrite_p.h"

namespace kinora::jit {

namespace {

constexpr size_t kWorthAnIf = 40;  // instructions

// Part of the item that the instruction before it belongs to.
bool continues_item(Op op) {
    return op == Op::Merge || op == Op::LoopOut || op == Op::Result;
}

bool is_input(Op op) {
    return op == Op::ConstF || op == Op::ConstI || op == Op::ConstM || op == Op::Input ||
           op == Op::FrameLoad;
}

class ProductGate {
  public:
    ProductGate(Module& module, std::span<const size_t> products, std::span<const size_t> factors)
        : m_(module), f_(module.kernel()), effects_(has_effects(module)) {
        std::span<const Value> results = f_.args_of(f_.insts.back());
        for (size_t k : products) products_.push_back(results[k]);
        for (size_t k : factors) factors_.push_back(results[k]);
        for (size_t k = 0; k < results.size(); ++k)
            if (std::find(products.begin(), products.end(), k) == products.end())
                others_.push_back(results[k]);
    }

    bool run() {
        constexpr int kDeepestSum = 10;
        for (Value product : products_)
            if (!vanishes(product, kDeepestSum)) return false;
        list_items();
        find_early();
        if (!is_worth_it()) return false;
        write();
        return true;
    }

  private:
    struct Item {
        Value first, end;
        bool early = false;
    };
    static constexpr int32_t kRecords = -1;  // beside the numbers of arrays

    // Surely 0 where all factors are, if its other operands are finite.
    bool vanishes(Value v, int depth) const {
        if (std::find(factors_.begin(), factors_.end(), v) != factors_.end()) return true;
        const Inst& inst = f_.insts[v];
        if (inst.op == Op::ConstF) return float_of(inst.imm) == 0;
        if (depth-- == 0) return false;
        switch (inst.op) {
            case Op::Mul:
                return vanishes(inst.a, depth) || vanishes(inst.b, depth);
            case Op::Fma:
                return (vanishes(inst.a, depth) || vanishes(inst.b, depth)) &&
                       vanishes(inst.c, depth);
            case Op::Add:
            case Op::Sub:
            case Op::Merge:
                return vanishes(inst.a, depth) && vanishes(inst.b, depth);
            case Op::Select:
                return vanishes(inst.b, depth) && vanishes(inst.c, depth);
            case Op::Neg:
            case Op::Abs:
                return vanishes(inst.a, depth);
            default:
                return false;
        }
    }

    void list_items() {
        item_of_.resize(f_.insts.size());
        int depth = 0;
        for (Value v = 0; v < f_.insts.size(); ++v) {
            Op op = f_.insts[v].op;
            if (depth == 0 && !continues_item(op)) items_.push_back({v, v});
            depth += op == Op::If || op == Op::Loop;
            depth -= op == Op::EndIf || op == Op::EndLoop;
            items_.back().end = v + 1;
            item_of_[v] = items_.size() - 1;
        }
    }

    // ---- what is early

    bool must_stay(const Inst& inst) const {
        if (inst.op == Op::Call) return effects_[static_cast<size_t>(inst.imm)];
        if (inst.op == Op::Service) return !m_.services[static_cast<size_t>(inst.imm)].pure;
        return is_input(inst.op) || inst.op == Op::Param;
    }

    void make_early(Value v) {
        if (v == kNone || items_[item_of_[v]].early) return;
        items_[item_of_[v]].early = true;
        open_.push_back(item_of_[v]);
    }

    void find_early() {
        for (Value v : others_) make_early(v);
        for (Value v : factors_) make_early(v);
        for (Value v = 0; v < f_.insts.size(); ++v)
            if (must_stay(f_.insts[v])) make_early(v);
        do {
            for (; !open_.empty(); need_operands(items_[open_.back()])) {
            }
            keep_order_of_memory();
        } while (!open_.empty());
    }

    void need_operands(const Item& item) {
        open_.pop_back();
        for (Value v = item.first; v < item.end; ++v) {
            const Inst& inst = f_.insts[v];
            for (Value operand : {inst.a, inst.b, inst.c}) make_early(operand);
            for (Value operand : f_.args_of(inst)) make_early(operand);
        }
    }

    // What touches an array before an early item does is early too.
    void keep_order_of_memory() {
        std::vector<bool> touched(f_.arrays.size() + 1, false);
        for (size_t k = items_.size(); k-- > 0;) {
            const Item& item = items_[k];
            for (Value v = item.first; v < item.end; ++v) {
                int32_t memory = 0;
                if (!touches(f_.insts[v], &memory)) continue;
                auto at = static_cast<size_t>(memory + 1);
                if (item.early)
                    touched[at] = true;
                else if (touched[at])
                    make_early(item.first);
            }
        }
    }

    bool touches(const Inst& inst, int32_t* memory) const {
        bool array = inst.op == Op::ArrayLoad || inst.op == Op::ArrayStore;
        bool record = inst.op == Op::RecordCount || inst.op == Op::RecordField ||
                      inst.op == Op::RecordUniform;
        if (inst.op == Op::Service) {
            const ServiceInfo& service = m_.services[static_cast<size_t>(inst.imm)];
            record = !service.pure && gives_handle(service);
        }
        *memory = array ? inst.imm : kRecords;
        return array || record;
    }

    bool is_worth_it() const {
        size_t count = 0;
        for (const Item& item : items_) {
            if (item.early || f_.insts[item.first].op == Op::Return) continue;
            for (Value v = item.first; v < item.end; ++v) {
                Op op = f_.insts[v].op;
                if (op == Op::Loop || op == Op::Service || op == Op::Call) return true;
                ++count;
            }
        }
        return count >= kWorthAnIf;
    }

    // ---- the new order

    void write() {
        Rewrite r(f_);
        for (const Item& item : items_)
            for (Value v = item.first; item.early && v < item.end; ++v) r.copy(v);
        Value zero = r.append({.op = Op::ConstF, .type = Type::F});
        Value seen = write_mask(r, zero);
        Value gate = r.append({.op = Op::If, .a = seen});
        for (const Item& item : items_)
            for (Value v = item.first; !item.early && v < item.end; ++v)
                if (r.old[v].op != Op::Return) copy_masked(r, v, seen);
        r.append({.op = Op::EndIf, .imm = static_cast<int32_t>(gate)});
        merge_products(r, gate, zero);
        r.copy(static_cast<Value>(r.old.size() - 1));
    }

    // Where a factor is not 0; NaN is not.
    Value write_mask(Rewrite& r, Value zero) const {
        Value none = kNone;
        for (size_t k = 0; k < factors_.size(); ++k) {
            if (std::find(factors_.begin(), factors_.begin() + long(k), factors_[k]) !=
                factors_.begin() + long(k))
                continue;
            Value is_zero =
                r.append({.op = Op::Eq, .type = Type::M, .a = r.renamed[factors_[k]], .b = zero});
            none = none == kNone
                       ? is_zero
                       : r.append({.op = Op::MAnd, .type = Type::M, .a = none, .b = is_zero});
        }
        return r.append({.op = Op::MNot, .type = Type::M, .a = none});
    }

    // What acts or branches does so for the points that are seen.
    void copy_masked(Rewrite& r, Value v, Value seen) const {
        const Inst& inst = r.old[v];
        constexpr Op kMaskedByFirst[] = {Op::If, Op::Loop, Op::Call, Op::Service, Op::Fault};
        bool first = std::find(std::begin(kMaskedByFirst), std::end(kMaskedByFirst), inst.op) !=
                     std::end(kMaskedByFirst);
        bool third = inst.op == Op::ArrayStore;
        if (!first && !third) {
            r.copy(v);
            return;
        }
        Value mask = r.renamed[first ? inst.a : inst.c];
        const Inst& known = r.function.insts[mask];
        if (known.op == Op::ConstM && known.imm != 0)
            mask = seen;
        else
            mask = r.append({.op = Op::MAnd, .type = Type::M, .a = mask, .b = seen});
        Inst& copied = r.function.insts[r.copy(v)];
        (first ? copied.a : copied.c) = mask;
    }

    void merge_products(Rewrite& r, Value gate, Value zero) const {
        std::vector<Value> done;
        for (Value product : products_) {
            bool again = std::find(done.begin(), done.end(), product) != done.end();
            if (again || items_[item_of_[product]].early) continue;
            done.push_back(product);
            r.renamed[product] = r.append({.op = Op::Merge,
                                           .type = Type::F,
                                           .a = r.renamed[product],
                                           .b = zero,
                                           .imm = static_cast<int32_t>(gate)});
        }
    }

    Module& m_;
    Function& f_;
    std::vector<bool> effects_;                       // of functions
    std::vector<Value> products_, factors_, others_;  // results
    std::vector<Item> items_;
    std::vector<size_t> item_of_;  // of instructions
    std::vector<size_t> open_;     // early items whose operands are not looked at yet
};

}  // namespace

bool skip_zero_products(Module& module, std::span<const size_t> products,
                        std::span<const size_t> factors) {
    return ProductGate(module, products, factors).run();
}

}  // namespace kinora::jit
