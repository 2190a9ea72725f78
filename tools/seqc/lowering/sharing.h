#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "lowering/order_plan.h"
#include "lowering/reduced_step.h"

namespace nplc::seqc {

using Branches = std::uint32_t;  ///< a set of branches that send

struct Branch {
    std::uint16_t behaviour = 0;
    const std::vector<Send>* sends = nullptr;
    std::size_t last_fast = 0;  ///< position of its last FastMAC order + 1; 0: none
};

/// Terms that send one order for some branches.
struct Column {
    Branches branches = 0;
    const Send* send = nullptr;
};

struct Way {
    std::vector<Column> columns;
    std::size_t terms = 0;
    bool shares = false;  ///< some branches have a group in common
};

/// How branches of a reduced step can send with terms in common.
class Sharing {
  public:
    using Regions = std::optional<std::vector<Region>>;

    explicit Sharing(const ReducedStep& half);

    const std::vector<Branch>& branches() const { return branches_; }

    /// Disjoint regions that hold the cases of these branches; none where the table cannot tell them apart.
    const Regions& regions(Branches set);

    /// The columns in which the branches of `group` send their orders with the fewest terms; nothing if that
    /// cannot be, or is too much to look for. With `own_ends` the last FastMAC order of a branch is not
    /// shared with that of one that goes on differently, since it carries the next step.
    const std::optional<Way>& align(Branches group, bool own_ends);

  private:
    struct Best {
        std::size_t cost = SIZE_MAX;  // terms, and less where fewer branches share
        std::size_t from = 0;
        Column column;
    };

    bool contains(Branches set, std::size_t reduced) const {
        return (set & sender_[half_.wanted[reduced]]) != 0;
    }
    Regions make_regions(Branches set) const;
    std::optional<Way> make_way(Branches group, bool own_ends);
    bool ends_clash(Branches set, const std::vector<std::size_t>& positions) const;
    std::optional<Column> column_of(std::uint32_t pick, const std::vector<std::size_t>& members,
                                    const std::vector<std::size_t>& positions) const;
    void extend(std::size_t state, const std::vector<std::size_t>& members, bool own_ends,
                std::vector<Best>& best);

    const ReducedStep& half_;
    std::vector<Branch> branches_;
    std::vector<Branches> sender_;  // by behaviour: the branch that it is, or none
    std::map<Branches, Regions> regions_;
    std::map<std::pair<Branches, bool>, std::optional<Way>> aligned_;
};

}  // namespace nplc::seqc
