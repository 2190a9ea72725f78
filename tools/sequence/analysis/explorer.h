#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "edges.h"
#include "states.h"
#include "successors.h"
#include "target_hits.h"

namespace nplc::verify {

/// Breadth-first exploration of all reachable states, within the bound.
class Explorer {
  public:
    using Node = States::Node;
    static constexpr Node kNone = States::kNone;
    using Edge = Edges::Edge;

    Explorer(const Machine& machine, const Precision& precision);

    void explore(const std::vector<Target>& targets);

    bool complete() const { return complete_; }
    std::size_t size() const { return states_.size(); }
    const Place& place(Node node) const { return states_.place(node); }
    /// The minimum number of scans to reach it.
    std::uint32_t depth(Node node) const { return states_.depth(node); }
    const Machine& machine() const { return scans_.machine(); }
    std::uint64_t steps_begun() const { return steps_begun_; }

    /// The shortest course to a target, or to a missed deadline; empty if there is none.
    std::vector<CourseScan> course_to(std::size_t target) const;
    std::vector<CourseScan> course_to_missed_deadline() const;
    bool hit(std::size_t target) const { return hits_[target].found(); }
    bool missed_deadline() const { return missed_.found(); }
    /// Missed by the end of the last scan, else by the next one.
    bool missed_at_end() const { return missed_at_end_; }
    /// The scans before the one that begins in `node`.
    std::vector<CourseScan> course_to_node(Node node) const;

    bool has_all_edges() const { return complete_ && edges_.has_all(); }
    const std::vector<Edge>& edges() const { return edges_.all(); }
    std::span<const Edge> edges_from(Node node) const { return edges_.from(node); }
    /// Made when they are first asked for, once all is explored.
    const EdgesBack& edges_back();
    const Group& group_of(const Edge& edge) const { return machine().group(edge.group); }
    /// The first node from which a scan of a group was found; kNone if there is none.
    Node first_use(const Group& group) const { return first_uses_[group.number]; }
    /// That scan.
    const Edge& first_edge_with(const Group& group) const;
    View view_after(const Place& place, const Group& group) const {
        return scans_.landing(place, group).view();
    }
    /// The images with which a scan that begins there is possible.
    ImageSet allowed(const Place& place) const { return scans_.allowed(place); }
    /// The images with which the scan of an edge is possible.
    ImageSet images_of(const Edge& edge) const { return images_of(edge, allowed(place(edge.from))); }
    ImageSet images_of(const Edge& edge, const ImageSet& allowed_there) const {
        return Successors::narrowed(group_of(edge).images & allowed_there, place(edge.to));
    }
    CourseScan scan_of(const Edge& edge, const ImageSet& images) const;
    CourseScan scan_of(const Place& place, const Group& group, const ImageSet& images) const;
    /// It has no effect.
    bool is_idle(const Place& place, const Group& group) const { return scans_.is_idle(place, group); }

  private:
    void explore_guided();
    std::uint32_t distance(const Place& place) const;
    /// The limit of work on times is reached: the exploration is incomplete.
    bool is_worn_out();
    void visit_plain(Node node);
    void visit(Node node);
    void note_missed(const Place& here, const Zone& zone, Node node, const Group& group, const View& view,
                     const Successors::Parts& split, const ImageSet& images);
    void add(const Place& place, const Zone& zone, const States::Origin& origin);
    const Precision& precision() const { return scans_.precision(); }

    Successors scans_;
    States states_;
    Edges edges_;
    std::optional<EdgesBack> back_;
    std::vector<std::vector<Node>> open_;  ///< guided: by the length of the shortest course through them
    std::vector<Node> first_uses_;         ///< by group
    TargetHits hits_;
    Hit missed_;
    bool missed_at_end_ = false;
    std::uint64_t steps_begun_ = 0;
    bool complete_ = true;
};

}  // namespace nplc::verify
