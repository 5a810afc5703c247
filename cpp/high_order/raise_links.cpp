// SPDX-License-Identifier: BSD-3-Clause
// The finished mesh: rows of elements, periodic images, and places of nodes on the geometry.
#include <functional>
#include <set>

#include "high_order/raiser.h"
#include "high_order/thresholds.h"
#include "model/nodes_by_place.h"
#include "periodic/thresholds.h"
#include "support/infinity.h"
#include "support/rounding_of.h"

namespace carreau {

using namespace thresholds::high_order;

void Raiser::fill() {
  std::vector<std::int32_t> number(elements_.size());
  std::int32_t triangles = 0, quads = 0;
  for (const Element& e : elements_) {
    const int ref = mesh_.faces[e.face].shown_ref();
    std::vector<std::int32_t>& rows = e.corners == 4 ? out_.quads : out_.triangles;
    rows.insert(rows.end(), e.node.begin(), e.node.begin() + static_cast<std::ptrdiff_t>(shape(e).node_count()));
    (e.corners == 4 ? out_.quad_refs : out_.triangle_refs).push_back(ref);
    number[&e - elements_.data()] = e.corners == 4 ? quads++ : triangles++;
  }
  for (const std::size_t k : invalid_) out_.invalid.push_back(number[k] + (elements_[k].corners == 4 ? triangles : 0));
  std::sort(out_.invalid.begin(), out_.invalid.end());
  for (const std::size_t k : invalid_) list_coarse(elements_[k]);
  for (const CurveMesh& curve : mesh_.curves)
    for (std::size_t k = 1; k < curve.vertices.size(); ++k) {
      const std::int32_t a = curve.vertices[k - 1], b = curve.vertices[k];
      out_.edges.insert(out_.edges.end(), {a, b});
      for (std::size_t m = 1; m < p_; ++m) out_.edges.push_back(node_between(a, b, m));
      out_.edge_refs.push_back(curve.shown_ref());
    }
  for (const FaceMesh& face : mesh_.faces)
    if (!face.name.empty()) out_.face_names.emplace_back(face.shown_ref(), face.name);
}

void Raiser::link_nodes(const PeriodicLink& of) {
  PeriodicLink link{of.dimension, of.master, of.slave, of.map, {}};
  std::map<std::int32_t, std::int32_t> master;
  for (const auto& [slave, image] : of.nodes)
    if (slave < out_.corners && image < out_.corners) master.emplace(slave, image), link.nodes.push_back({slave, image});
  const auto link_edge = [&](std::int32_t a, std::int32_t b) {
    const auto ma = master.find(a), mb = master.find(b);
    if (ma == master.end() || mb == master.end() || !edges_.contains(ordered(a, b)) || !edges_.contains(ordered(ma->second, mb->second))) return;
    for (std::size_t m = 1; m < p_; ++m) link.nodes.push_back({node_between(a, b, m), node_between(ma->second, mb->second, m)});
  };
  if (of.dimension == 1 && of.master == of.slave) return link_itself(of);
  if (of.dimension == 1)
    for (const CurveMesh& curve : mesh_.curves)
      for (std::size_t k = 1; curve.shown_ref() == of.slave && k < curve.vertices.size(); ++k) link_edge(curve.vertices[k - 1], curve.vertices[k]);
  if (of.dimension == 2) {
    std::map<std::vector<std::int32_t>, const Element*> masters;  // by ascending vertices
    const auto corners_of = [](const Element& e) { return std::vector<std::int32_t>(e.node.begin(), e.node.begin() + e.corners); };
    for (const Element& e : elements_) {
      if (mesh_.faces[e.face].shown_ref() != of.master) continue;
      std::vector<std::int32_t> corners = corners_of(e);
      std::sort(corners.begin(), corners.end());
      masters.emplace(std::move(corners), &e);
    }
    for (const Element& e : elements_) {
      if (mesh_.faces[e.face].shown_ref() != of.slave) continue;
      std::vector<std::int32_t> images;
      for (const std::int32_t v : corners_of(e))
        if (const auto image = master.find(v); image != master.end()) images.push_back(image->second);
      for (int i = 0; i < e.corners; ++i) link_edge(e.node[static_cast<std::size_t>(i)], e.node[static_cast<std::size_t>((i + 1) % e.corners)]);
      std::sort(images.begin(), images.end());
      const auto found = masters.find(images);
      if (found != masters.end()) link_inner(e, *found->second, link);
    }
  }
  std::sort(link.nodes.begin(), link.nodes.end());
  link.nodes.erase(std::unique(link.nodes.begin(), link.nodes.end()), link.nodes.end());
  out_.periodic.push_back(std::move(link));
}

void Raiser::link_itself(const PeriodicLink& of) {
  const auto is_of_curve = [&of](const PeriodicLink& link) { return link.dimension == 1 && link.master == of.master && link.slave == of.master; };
  if (std::any_of(out_.periodic.begin(), out_.periodic.end(), is_of_curve)) return;
  std::vector<std::int32_t> nodes;
  for (const CurveMesh& curve : mesh_.curves)
    if (curve.shown_ref() == of.master) nodes.insert(nodes.end(), curve.vertices.begin(), curve.vertices.end());
  for (const MeshAssociation::OnCurve& on : on_curves_)
    if (on.ref == of.master) nodes.push_back(on.node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const NodesByPlace::Positions position = [this](std::int32_t v) { return out_.nodes[v]; };
  const NodesByPlace places(nodes, position, out_.corners, thresholds::periodic::max_gap * result_.report.diag);
  std::vector<NodeImages> images;
  for (const PeriodicLink& link : mesh_.periodic) {
    if (!is_of_curve(link)) continue;
    NodeImages& all = images.emplace_back();
    for (const std::int32_t v : nodes) places.for_near(link.map(out_.nodes[v]), v, [&](std::int32_t w) { all.push_back({v, w}); });
  }
  std::vector<NodeImages> pairs = pairs_of_orbits(images);
  std::size_t m = 0;
  for (const PeriodicLink& link : mesh_.periodic) {
    if (!is_of_curve(link)) continue;
    std::sort(pairs[m].begin(), pairs[m].end());
    out_.periodic.push_back({1, of.master, of.master, link.map, std::move(pairs[m++])});
  }
}

void Raiser::follow_on_curves() {
  const double exact = rounding_of::places * thresholds::periodic::max_gap * result_.report.diag;
  std::set<std::int32_t> moved;
  for (const bool itself : {true, false})
    for (const PeriodicLink& link : out_.periodic) {
      if (link.dimension != 1 || (link.master == link.slave) != itself) continue;
      for (const auto& [slave, master] : link.nodes)
        if (const auto found = place_of_.find(slave); found != place_of_.end() && move_on_curve(slave, found->second, master, link.map, exact))
          moved.insert(slave);
    }
  for (std::size_t k = 0; k < elements_.size() && !moved.empty(); ++k) {
    const Element& e = elements_[k];
    if (std::none_of(e.node.begin(), e.node.begin() + static_cast<std::ptrdiff_t>(shape(e).node_count()), [&](std::int32_t v) { return moved.contains(v); })) continue;
    std::erase(invalid_, k);
    if (score(e) < least_jacobian) invalid_.insert(std::lower_bound(invalid_.begin(), invalid_.end(), k), k);
  }
}

bool Raiser::move_on_curve(std::int32_t node, const CurvePlace& place, std::int32_t master, const Isometry& map, double exact) {
  const Vec3 target = map(out_.nodes[master]);
  const bool is_near = norm(target - out_.nodes[node]) <= exact, is_off = !is_finite(node_uv_[master]);
  node_uv_[node] = node_uv_[master];
  if (is_near || is_off) {
    out_.nodes[node] = target;
    return !is_near;
  }
  const CurveSupport& support = model_.support(*place.use);
  double& t = on_curves_[place.on_curve].t;
  const CurvePoint found = find_closest(model_, *place.use, t, support.t.front(), support.t.back(), target);
  t = found.t;
  out_.nodes[node] = found.distance <= exact ? target : found.xyz;
  for (std::size_t k = place.side; k < on_sides_.size() && on_sides_[k].node == node; ++k) {
    ClosestPoint point{on_sides_[k].uv, {}, 0};
    find_closest(model_.cad, mesh_.faces[static_cast<std::size_t>(on_sides_[k].face)].ref, {&target, 1}, {&point, 1});
    on_sides_[k].uv = point.uv;
  }
  return true;
}

void Raiser::follow_masters() {
  follow_on_curves();
  std::vector<char> on_curve(out_.nodes.size(), 0);
  for (const MeshAssociation::OnCurve& on : on_curves_) on_curve[on.node] = 1;
  for (const PeriodicLink& link : out_.periodic) {
    if (link.dimension != 2) continue;
    const std::map<std::int32_t, std::int32_t> master = [&] {
      std::map<std::int32_t, std::int32_t> by_slave;
      for (const auto& [slave, image] : link.nodes) by_slave.emplace(slave, image);
      return by_slave;
    }();
    std::map<std::size_t, Wanted> wanted;  // by face
    std::vector<std::size_t> changed;
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      const Element& e = elements_[k];
      if (mesh_.faces[e.face].shown_ref() != link.slave) continue;
      const double size = norm(out_.nodes[e.node[0]] - out_.nodes[e.node[2]]);
      for (std::size_t i = static_cast<std::size_t>(e.corners); i < shape(e).node_count(); ++i) {
        const auto found = master.find(e.node[i]);
        if (found == master.end() || on_curve[e.node[i]] != 0) continue;
        const Vec3 image = link.map(out_.nodes[found->second]);
        if (norm(image - out_.nodes[e.node[i]]) <= rounding_of::digits * size) continue;
        changed.push_back(k);
        if (is_finite(node_uv_[found->second]) && is_finite(node_uv_[e.node[i]])) {
          Wanted& of = wanted[static_cast<std::size_t>(e.face)];
          of.node.push_back(e.node[i]), of.target.push_back(image), of.guess.push_back(node_uv_[e.node[i]]), of.reach.push_back(rounding_of::sizes * size);
        } else {
          out_.nodes[e.node[i]] = image, node_uv_[e.node[i]] = {nan, nan};
        }
      }
    }
    for (const auto& [f, of] : wanted) place(f, of);
    std::erase_if(invalid_, [&](std::size_t k) { return std::binary_search(changed.begin(), changed.end(), k); });
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    for (const std::size_t k : changed)
      if (score(elements_[k]) < least_jacobian) invalid_.push_back(k);
    std::sort(invalid_.begin(), invalid_.end());
  }
}

void Raiser::link_inner(const Element& slave, const Element& master, PeriodicLink& link) const {
  for (std::size_t i = shape(slave).first_inner(); i < shape(slave).node_count(); ++i) {
    std::int32_t nearest = -1;
    double least = infinity;
    for (std::size_t k = shape(master).first_inner(); k < shape(master).node_count(); ++k)
      if (const double apart = norm(link.map(out_.nodes[master.node[k]]) - out_.nodes[slave.node[i]]); apart < least) least = apart, nearest = master.node[k];
    if (nearest >= 0) link.nodes.push_back({slave.node[i], nearest});
  }
}

void Raiser::associate_nodes() {
  MeshAssociation& all = out_.association;
  const auto shown = [this](std::int32_t ref) {
    const auto found = model_.model.shown_points.find(ref);
    return found != model_.model.shown_points.end() ? found->second : ref;
  };
  all = associate(mesh_, result_.curve_parameters, {}, shown, [](std::size_t face, std::int32_t) { return face; });
  const auto corner = [this](const auto& record) { return record.node < out_.corners; };
  std::erase_if(all.curves, std::not_fn(corner)), std::erase_if(all.faces, std::not_fn(corner));
  all.entities.resize(static_cast<std::size_t>(out_.corners)), all.entities.resize(out_.nodes.size());
  all.cell_uv.clear();
  const auto is_on_surface = [this](std::int32_t node) { return is_finite(node_uv_[node]); };
  for (const MeshAssociation::OnCurve& on : on_curves_) {
    all.entities[on.node] = {1, on.ref};
    if (is_on_surface(on.node)) all.curves.push_back(on);
  }
  std::stable_sort(on_sides_.begin(), on_sides_.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  for (const auto& [node, face, uv] : on_sides_)
    if (is_on_surface(node)) all.faces.push_back({node, mesh_.faces[face].shown_ref(), uv});
  for (const int corners : {3, 4})
    for (const Element& e : elements_)
      if (e.corners == corners) associate_element(e, all);
  all.sort();
}

void Raiser::associate_element(const Element& e, MeshAssociation& all) {
  const FaceMesh& face = mesh_.faces[e.face];
  const auto corner = [&](int i) -> Vec2 { return face.uv[e.local[i]]; };
  const auto inner = static_cast<std::size_t>(e.corners);
  for (std::size_t i = 0; i < shape(e).node_count(); ++i) {
    const std::int32_t node = e.node[i];
    if (i < inner) {
      all.cell_uv.push_back(corner(static_cast<int>(i)));
    } else if (all.entities[node].dimension == 2) {
      all.entities[node].ref = face.shown_ref();
      if (is_finite(node_uv_[node])) all.faces.push_back({node, face.shown_ref(), node_uv_[node]});
      all.cell_uv.push_back(node_uv_[node]);
    } else {  // on a curve, whose side of a seam is near the element
      const double s = shape(e).reference()[i].x(), t = shape(e).reference()[i].y();
      const Vec2 near = e.corners == 4 ? Vec2((1 - s) * (1 - t) * corner(0) + s * (1 - t) * corner(1) + s * t * corner(2) + (1 - s) * t * corner(3))
                                       : Vec2((1 - s - t) * corner(0) + s * corner(1) + t * corner(2));
      Vec2 best{nan, nan};
      auto on = std::lower_bound(on_sides_.begin(), on_sides_.end(), node, [](const auto& side, std::int32_t n) { return side.node < n; });
      for (; on != on_sides_.end() && on->node == node && is_finite(node_uv_[node]); ++on)
        if (on->face == e.face && !(norm(on->uv - near) >= norm(best - near))) best = on->uv;
      all.cell_uv.push_back(best);
    }
  }
}

void Raiser::list_coarse(const Element& e) {
  const FaceMesh& face = mesh_.faces[e.face];
  const auto list = [&](bool of_curves) {
    for (int i = 0; i < e.corners; ++i) {
      const Key key = ordered(face.vertex[e.local[i]], face.vertex[e.local[(i + 1) % e.corners]]);
      if (of_curves || !edges_.at(key).fixed) out_.coarse.push_back(key);
    }
  };
  const std::size_t before = out_.coarse.size();
  list(false);
  if (out_.coarse.size() == before) list(true);
}

}  // namespace carreau
