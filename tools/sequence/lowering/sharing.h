#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "lowering/order_plan.h"
#include "lowering/reduced_step.h"

namespace nplc::seqc {

using Branches = std::uint32_t;  ///< a bit set of branches with orders

struct Branch {
    std::uint16_t behaviour = 0;
    const std::vector<Send>* sends = nullptr;
    std::size_t last_fast = 0;  ///< position of its last FastMAC order + 1; 0: none
};

/// Terms that send one order for several branches.
struct Column {
    Branches branches = 0;
    const Send* send = nullptr;
};

struct Way {
    std::vector<Column> columns;
    std::size_t terms = 0;
    bool shares = false;  ///< some branches are in a common group
};

/// How branches of a reduced step can send orders with shared terms.
class Sharing {
  public:
    using Regions = std::optional<std::vector<Region>>;

    explicit Sharing(const ReducedStep& error_branch);

    const std::vector<Branch>& branches() const { return branches_; }

    /// Disjoint regions that contain the cases of these branches; empty if the table cannot distinguish them.
    const Regions& regions(Branches set);

    /// The columns in which the branches of `group` send their orders with the fewest terms; empty if that is
    /// not possible or the search is too large. With `own_ends` the last FastMAC order of a branch is not
    /// shared with branches that have another next step, since it carries the next step.
    const std::optional<Way>& align(Branches group, bool own_ends);

  private:
    struct Best {
        std::size_t cost = SIZE_MAX;  // terms; lower if fewer branches share
        std::size_t from = 0;
        Column column;
    };

    bool contains(Branches set, std::size_t reduced) const {
        return (set & sender_[error_branch_.wanted[reduced]]) != 0;
    }
    Regions make_regions(Branches set) const;
    std::optional<Way> make_way(Branches group, bool own_ends);
    bool ends_clash(Branches set, const std::vector<std::size_t>& positions) const;
    std::optional<Column> column_of(std::uint32_t pick, const std::vector<std::size_t>& members,
                                    const std::vector<std::size_t>& positions) const;
    void extend(std::size_t state, const std::vector<std::size_t>& members, bool own_ends,
                std::vector<Best>& best);

    const ReducedStep& error_branch_;
    std::vector<Branch> branches_;
    std::vector<Branches> sender_;  // by behaviour: its branch, or none
    std::map<Branches, Regions> regions_;
    std::map<std::pair<Branches, bool>, std::optional<Way>> aligned_;
};

}  // namespace nplc::seqc
