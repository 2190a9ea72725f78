#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "states.h"

namespace nplc::verify {

/// The transitions between states, in the order of the nodes they begin in; all of them or none.
class Edges {
  public:
    using Node = States::Node;

    /// A transition by a scan. Those of one node are consecutive, in the order of nodes.
    struct Edge {
        Node from = States::kNone;
        Node to = States::kNone;
        std::uint32_t group = 0;  ///< its number
    };

    void reserve() { edges_.reserve(std::size_t{1} << 20U); }
    /// What is added from now on begins in the next node; after the last one once more.
    void begin_node() { first_edge_.push_back(static_cast<std::uint32_t>(edges_.size())); }
    void add(const Edge& edge) {
        if (!has_all_) return;
        has_all_ = edges_.size() < kMostEdges;
        if (has_all_) {
            edges_.push_back(edge);
        } else {
            edges_ = {};
        }
    }
    /// There are no more than can be kept.
    bool has_all() const { return has_all_; }
    const std::vector<Edge>& all() const { return edges_; }
    std::span<const Edge> from(Node node) const {
        return std::span(edges_).subspan(first_edge_[node], first_edge_[node + 1] - first_edge_[node]);
    }

  private:
    static constexpr std::size_t kMostEdges = 6'000'000;

    std::vector<Edge> edges_;
    std::vector<std::uint32_t> first_edge_;  ///< by node, and the end
    bool has_all_ = true;
};

/// The same transitions by the nodes they lead to.
class EdgesBack {
  public:
    EdgesBack(const std::vector<Edges::Edge>& edges, std::size_t nodes)
        : first_(nodes + 1, 0), from_(edges.size()) {
        for (const Edges::Edge& edge : edges) ++first_[edge.to + 1];
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        std::vector<std::uint32_t> next(first_.begin(), first_.end());
        for (const Edges::Edge& edge : edges) from_[next[edge.to]++] = edge.from;
    }
    /// From where an edge leads to it.
    std::span<const Edges::Node> to(Edges::Node node) const {
        return std::span(from_).subspan(first_[node], first_[node + 1] - first_[node]);
    }

  private:
    std::vector<std::uint32_t> first_;  ///< by node, and the end
    std::vector<Edges::Node> from_;
};

}  // namespace nplc::verify
