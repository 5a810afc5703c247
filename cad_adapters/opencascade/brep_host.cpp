#include "brep_host.h"

#include <BRepBndLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>
#include <gp_Vec2d.hxx>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>

#include "evaluators.h"
#include "face_check.h"
#include "faults.h"

namespace carreau_occ {

namespace {

struct HostCurve {
  double first = 0, last = 1;
  int edge = 0;            // number of the edge
  int end1 = 0, end2 = 0;  // numbers of the vertices at first and last
  bool forward = true;     // the domain lies on the left of the curve, as OpenCASCADE counts (u, v)
  bool internal = false;
};

struct HostFace {
  bool swapped = false;  // u and v exchanged
  std::vector<HostCurve> curves;
  std::string name;
  int32_t rgb = -1;    // 0xRRGGBB, -1: no colour
  double size = 0;     // 0: no size of its own
  std::string broken;  // why it cannot be meshed; "": it can
};

std::string sentence_of(const Standard_Failure& failure) {
  return std::string("OpenCASCADE: ") + failure.DynamicType()->Name() + ": " + failure.GetMessageString();
}

void store(const gp_Pnt& p, double* to) { to[0] = p.X(), to[1] = p.Y(), to[2] = p.Z(); }
void store(const gp_Vec& v, double* to) { to[0] = v.X(), to[1] = v.Y(), to[2] = v.Z(); }

}  // namespace

struct BrepHost::State {
  TopoDS_Shape shape;
  TopTools_IndexedMapOfShape faces, edges, vertices;
  std::vector<HostFace> host_faces;            // face number - 1
  std::vector<int> uses;                       // of each edge, by its number - 1
  std::vector<double> edge_size, vertex_size;  // smallest of the faces beside, by number - 1; 0: none
  Evaluators evaluators;
  std::mutex mutex;                     // of what follows: callbacks come from several threads
  std::map<int, std::string> failures;  // by face
  // By number - 1: faces whose surface, or curves, failed or could not be had. Not asked again, since a fault may have
  // left locks behind.
  std::unique_ptr<std::atomic<bool>[]> surface_failed, curves_failed;

  void collect();
  void collect_names(const ShapeFile& file);
  void collect_doubts(const ShapeFile& file);
  void collect_face(int number);

  static int32_t surface_batch(int32_t face, int64_t n, const double* uv, int32_t order, double* S, double* Su,
                               double* Sv, double* Suu, double* Suv, double* Svv, void* user) noexcept;
  static int32_t interval(int32_t face, int32_t ic, double* a, double* b, void* user) noexcept;
  static int32_t curve(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt,
                       void* user) noexcept;
  static int32_t surface_size(int32_t face, double u, double v, double* value, void* user) noexcept;
  static int32_t curve_size(int32_t face, int32_t ic, double t, double* value, void* user) noexcept;
  static int32_t point_size(int32_t point, double* value, void* user) noexcept;
  void collect_sizes();
  [[nodiscard]] double glue_tolerance() const;
  int32_t fail(int32_t face, const Standard_Failure& why) noexcept;
};

void BrepHost::State::collect() {
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  TopExp::MapShapes(shape, TopAbs_VERTEX, vertices);
  if (faces.IsEmpty()) throw std::runtime_error("the shape has no face");
  uses.assign(static_cast<std::size_t>(edges.Extent()), 0);
  host_faces.resize(static_cast<std::size_t>(faces.Extent()));
  evaluators.resize(host_faces.size());
  for (auto* failed : {&surface_failed, &curves_failed}) {
    *failed = std::make_unique<std::atomic<bool>[]>(host_faces.size());
    for (std::size_t f = 0; f < host_faces.size(); ++f) (*failed)[f] = true;
  }
  for (int f = 1; f <= faces.Extent(); ++f) {
    HostFace& face = host_faces[static_cast<std::size_t>(f - 1)];
    try {
      guarded([&] { collect_face(f); });
      if (face.curves.empty()) face.broken = "no edge bounds it";
    } catch (const Standard_Failure& error) {
      face.broken = sentence_of(error);
    } catch (const std::runtime_error& error) {
      face.broken = error.what();
    }
  }
}

void BrepHost::State::collect_face(int number) {
  const TopoDS_Face face = TopoDS::Face(faces(number));
  HostFace& host = host_faces[static_cast<std::size_t>(number - 1)];
  // A placement that mirrors turns the surface inside out and leaves the orientation of the face.
  host.swapped =
      (face.Orientation() == TopAbs_REVERSED) != (face.Location().Transformation().IsNegative() == Standard_True);
  // Wires are turned for the face taken forward.
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  std::vector<Handle(Geom2d_Curve)> images;
  for (TopExp_Explorer e(forward, TopAbs_EDGE); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    if (edge.Orientation() == TopAbs_EXTERNAL) continue;
    HostCurve curve;
    images.push_back(BRep_Tool::CurveOnSurface(edge, forward, curve.first, curve.last));
    if (images.back().IsNull()) throw std::runtime_error("an edge has no curve in its parameter plane");
    curve.edge = edges.FindIndex(edge);
    curve.end1 = vertices.FindIndex(TopExp::FirstVertex(edge, Standard_False));
    curve.end2 = vertices.FindIndex(TopExp::LastVertex(edge, Standard_False));
    curve.forward = edge.Orientation() == TopAbs_FORWARD;
    curve.internal = edge.Orientation() == TopAbs_INTERNAL;
    if (!curve.internal) ++uses[static_cast<std::size_t>(curve.edge - 1)];
    if (BRep_Tool::Degenerated(edge)) uses[static_cast<std::size_t>(curve.edge - 1)] = 2;
    host.curves.push_back(curve);
  }
  evaluators.set(static_cast<std::size_t>(number - 1), forward, std::move(images));
  for (const auto* failed : {&surface_failed, &curves_failed}) (*failed)[static_cast<std::size_t>(number - 1)] = false;
  refuse_unusable(forward);
}

// Wide parts first, so that the name of the narrowest part stays.
/// Own name and colour of each face, or those of the smallest part that holds it and has some.
void BrepHost::State::collect_names(const ShapeFile& file) {
  std::vector<std::pair<const ShapeFile::Label*, std::vector<int>>> parts;  // with their faces
  for (const ShapeFile::Label& label : file.labels) {
    std::vector<int> held;
    for (TopExp_Explorer e(label.part, TopAbs_FACE); e.More(); e.Next())
      if (const int number = faces.FindIndex(e.Current()); number > 0) held.push_back(number);
    parts.emplace_back(&label, std::move(held));
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& p, const auto& q) { return p.second.size() > q.second.size(); });
  const auto byte = [](double share) { return static_cast<int>(std::lround(255 * std::clamp(share, 0.0, 1.0))); };
  for (const auto& [label, held] : parts)
    for (const int number : held) {
      HostFace& face = host_faces[static_cast<std::size_t>(number - 1)];
      if (!label->name.empty()) face.name = label->name;
      if (label->has_colour) face.rgb = byte(label->red) << 16 | byte(label->green) << 8 | byte(label->blue);
    }
}

void BrepHost::State::collect_doubts(const ShapeFile& file) {
  for (const auto& [doubtful, why] : file.doubtful)
    for (TopExp_Explorer e(doubtful, TopAbs_FACE); e.More(); e.Next())
      for (int f = 1; f <= faces.Extent(); ++f)  // wherever an assembly puts it
        if (HostFace& face = host_faces[static_cast<std::size_t>(f - 1)];
            faces(f).IsPartner(e.Current()) && face.broken.empty())
          face.broken = why;
}

void BrepHost::State::collect_sizes() {
  edge_size.assign(uses.size(), 0);
  vertex_size.assign(static_cast<std::size_t>(vertices.Extent()), 0);
  const auto lower = [](double& size, double other) { size = size > 0 ? std::min(size, other) : other; };
  for (const HostFace& face : host_faces)
    for (const HostCurve& curve : face.curves) {
      if (!(face.size > 0)) continue;
      lower(edge_size[static_cast<std::size_t>(curve.edge - 1)], face.size);
      for (const int end : {curve.end1, curve.end2}) lower(vertex_size[static_cast<std::size_t>(end - 1)], face.size);
    }
}

namespace {
int32_t answer(double size, double* value) {
  if (!(size > 0)) return CARREAU_NO_ANSWER;
  *value = size;
  return 0;
}
}  // namespace

int32_t BrepHost::State::surface_size(int32_t face, double, double, double* value, void* user) noexcept {
  return answer(static_cast<State*>(user)->host_faces[static_cast<std::size_t>(face - 1)].size, value);
}

int32_t BrepHost::State::curve_size(int32_t face, int32_t ic, double, double* value, void* user) noexcept {
  const auto& state = *static_cast<State*>(user);
  const int edge = state.host_faces[static_cast<std::size_t>(face - 1)].curves[static_cast<std::size_t>(ic - 1)].edge;
  return answer(state.edge_size[static_cast<std::size_t>(edge - 1)], value);
}

int32_t BrepHost::State::point_size(int32_t point, double* value, void* user) noexcept {
  // Gluing numbers points where it cuts curves behind all others.
  const std::vector<double>& sizes = static_cast<State*>(user)->vertex_size;
  const auto index = static_cast<std::size_t>(point - 1);
  return index < sizes.size() ? answer(sizes[index], value) : CARREAU_NO_ANSWER;
}

int32_t BrepHost::State::fail(int32_t face, const Standard_Failure& why) noexcept {
  try {
    const std::scoped_lock lock(mutex);
    failures[face] = "face " + std::to_string(face) + ": " + sentence_of(why);
  } catch (...) {  // no memory for a sentence
  }
  return 1;
}

int32_t BrepHost::State::surface_batch(int32_t face, int64_t n, const double* uv, int32_t order, double* S, double* Su,
                                       double* Sv, double* Suu, double* Suv, double* Svv, void* user) noexcept {
  auto& state = *static_cast<State*>(user);
  std::atomic<bool>& failed = state.surface_failed[static_cast<std::size_t>(face - 1)];
  if (failed) return 1;
  const auto evaluate = [&] {
    const bool swapped = state.host_faces[static_cast<std::size_t>(face - 1)].swapped;
    const Evaluators::Surface surface = state.evaluators.surface(static_cast<std::size_t>(face - 1));
    if (swapped) std::swap(Su, Sv), std::swap(Suu, Svv);
    gp_Pnt p;
    gp_Vec d1u, d1v, d2u, d2v, d2uv;
    for (int64_t i = 0; i < n; ++i) {
      const double u = uv[2 * i + (swapped ? 1 : 0)], v = uv[2 * i + (swapped ? 0 : 1)];
      if (order >= 2) {
        surface.d2(u, v, p, d1u, d1v, d2u, d2v, d2uv);
        store(d2u, Suu + 3 * i), store(d2uv, Suv + 3 * i), store(d2v, Svv + 3 * i);
      } else if (order == 1) {
        surface.d1(u, v, p, d1u, d1v);
      } else {
        surface.d0(u, v, p);
      }
      store(p, S + 3 * i);
      if (order >= 1) store(d1u, Su + 3 * i), store(d1v, Sv + 3 * i);
    }
  };
  try {
    guarded(evaluate);
    return 0;
  } catch (const Standard_Failure& failure) {
    failed = true;
    return state.fail(face, failure);
  } catch (...) {
    return state.fail(face, Standard_Failure("out of memory"));
  }
}

int32_t BrepHost::State::interval(int32_t face, int32_t ic, double* a, double* b, void* user) noexcept {
  const HostCurve& curve = static_cast<State*>(user)
                               ->host_faces[static_cast<std::size_t>(face - 1)]
                               .curves[static_cast<std::size_t>(ic - 1)];
  *a = curve.first, *b = curve.last;
  return 0;
}

int32_t BrepHost::State::curve(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt,
                               void* user) noexcept {
  auto& state = *static_cast<State*>(user);
  std::atomic<bool>& failed = state.curves_failed[static_cast<std::size_t>(face - 1)];
  if (failed) return 1;
  const auto evaluate = [&] {
    const Evaluators::Curve curve =
        state.evaluators.curve(static_cast<std::size_t>(face - 1), static_cast<std::size_t>(ic - 1));
    gp_Pnt2d p;
    gp_Vec2d d1, d2;
    if (order >= 2)
      curve.d2(t, p, d1, d2);
    else if (order == 1)
      curve.d1(t, p, d1);
    else
      curve.d0(t, p);
    const int x = state.host_faces[static_cast<std::size_t>(face - 1)].swapped ? 1 : 0, y = 1 - x;
    C[x] = p.X(), C[y] = p.Y();
    if (order >= 1) Ct[x] = d1.X(), Ct[y] = d1.Y();
    if (order >= 2) Ctt[x] = d2.X(), Ctt[y] = d2.Y();
  };
  try {
    guarded(evaluate);
    return 0;
  } catch (const Standard_Failure& failure) {
    failed = true;
    return state.fail(face, failure);
  } catch (...) {
    return state.fail(face, Standard_Failure("out of memory"));
  }
}

BrepHost::BrepHost(const ShapeFile& file) : state_(std::make_unique<State>()) {
  state_->shape = file.shape;
  try {
    guarded([&] { state_->collect(), state_->collect_names(file), state_->collect_doubts(file); });
  } catch (const Standard_Failure& failure) {
    throw std::runtime_error(std::string("OpenCASCADE cannot read the topology: ") + failure.GetMessageString());
  }
}

BrepHost::~BrepHost() = default;

carreau_status BrepHost::give_to(carreau_session* session) {
  carreau_cad cad{};
  cad.struct_size = sizeof cad;
  cad.user = state_.get();
  cad.surface_order = cad.curve_order = 2;
  cad.reentrant = 1;
  cad.surface_batch = State::surface_batch;
  cad.curve_interval = State::interval;
  cad.curve = State::curve;
  state_->collect_sizes();
  cad.surface_size = State::surface_size;
  cad.curve_size = State::curve_size;
  cad.point_size = State::point_size;
  carreau_status status = carreau_set_cad(session, &cad);
  if (status == CARREAU_OK) status = carreau_model_clear(session);
  for (std::size_t f = 0; f < state_->host_faces.size() && status == CARREAU_OK; ++f) {
    const HostFace& face = state_->host_faces[f];
    if (!face.broken.empty()) continue;
    int32_t orientation = 0;
    for (std::size_t c = 0; c < face.curves.size() && orientation == 0; ++c)
      if (!face.curves[c].internal)
        orientation = static_cast<int32_t>(c + 1) * (face.curves[c].forward != face.swapped ? 1 : -1);
    const auto ref = static_cast<int32_t>(f + 1);
    status = carreau_model_add_face(session, ref, orientation);
    if (status == CARREAU_OK) status = carreau_model_name_face(session, ref, face.name.c_str());
    if (status == CARREAU_OK) status = carreau_model_color_face(session, ref, face.rgb);
    for (const HostCurve& curve : face.curves)
      if (status == CARREAU_OK)
        status = carreau_model_add_curve(session, ref, curve.internal ? CARREAU_INTERNAL : CARREAU_BOUNDARY, curve.edge,
                                         curve.end1, curve.end2);
  }
  return status;
}

bool BrepHost::set_face_size(const std::string& face, double size) {
  bool found = false;
  for (std::size_t f = 0; f < state_->host_faces.size(); ++f) {
    if (face != state_->host_faces[f].name && face != std::to_string(f + 1)) continue;
    state_->host_faces[f].size = size;
    found = true;
  }
  return found;
}

void BrepHost::exclude(int face, const std::string& why) {
  state_->host_faces[static_cast<std::size_t>(face - 1)].broken = why;
}

std::vector<std::pair<int, std::string>> BrepHost::excluded() const {
  std::vector<std::pair<int, std::string>> list;
  for (std::size_t f = 0; f < state_->host_faces.size(); ++f)
    if (!state_->host_faces[f].broken.empty()) list.emplace_back(static_cast<int>(f + 1), state_->host_faces[f].broken);
  return list;
}

const std::string& BrepHost::face_name(int number) const {
  return state_->host_faces[static_cast<std::size_t>(number - 1)].name;
}

int BrepHost::face_count() const noexcept { return state_->faces.Extent(); }
int BrepHost::edge_count() const noexcept { return state_->edges.Extent(); }
int BrepHost::vertex_count() const noexcept { return state_->vertices.Extent(); }

bool BrepHost::locate(int face, double u, double v, double* xyz, double* uv) const noexcept {
  const double given[2] = {u, v};
  const bool swapped = state_->host_faces[static_cast<std::size_t>(face - 1)].swapped;
  uv[0] = swapped ? v : u, uv[1] = swapped ? u : v;
  return State::surface_batch(face, 1, given, 0, xyz, nullptr, nullptr, nullptr, nullptr, nullptr, state_.get()) == 0;
}

std::vector<std::int32_t> BrepHost::curves(int face) const {
  std::vector<std::int32_t> edges;
  if (face < 1 || face > face_count()) return edges;
  for (const HostCurve& curve : state_->host_faces[static_cast<std::size_t>(face - 1)].curves)
    edges.push_back(curve.edge);
  return edges;
}

bool BrepHost::on_curve(int face, int ic, double share, double* uv) const noexcept {
  double a = 0, b = 0;
  if (State::interval(face, ic, &a, &b, state_.get()) != 0) return false;
  const double t = share < 1 ? a + share * (b - a) : b;
  return State::curve(face, ic, t, 0, uv, nullptr, nullptr, state_.get()) == 0;
}

double BrepHost::diagonal() const {
  // Faces that are broken may reach anywhere.
  TopoDS_Compound good;
  const BRep_Builder builder;
  builder.MakeCompound(good);
  bool all = true;
  for (int f = 1; f <= state_->faces.Extent(); ++f)
    if (state_->host_faces[static_cast<std::size_t>(f - 1)].broken.empty())
      builder.Add(good, state_->faces(f));
    else
      all = false;
  return diagonal_of(all ? state_->shape : good);
}

double BrepHost::glue_tolerance() const try {
  double tolerance = 0;
  guarded([&] { tolerance = state_->glue_tolerance(); });
  return tolerance;
} catch (const Standard_Failure&) {
  return 0;
}

double BrepHost::State::glue_tolerance() const {
  double tolerance = 0, shortest = std::numeric_limits<double>::infinity();
  int free = 0;
  for (int e = 1; e <= edges.Extent(); ++e) {
    if (uses[static_cast<std::size_t>(e - 1)] != 1) continue;
    const TopoDS_Edge edge = TopoDS::Edge(edges(e));
    ++free;
    tolerance = std::max(tolerance, BRep_Tool::Tolerance(edge));
    for (TopExp_Explorer v(edge, TopAbs_VERTEX); v.More(); v.Next())
      tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Vertex(v.Current())));
    Bnd_Box box;
    BRepBndLib::Add(edge, box, Standard_False);
    if (!box.IsVoid()) shortest = std::min(shortest, std::sqrt(box.SquareExtent()));
  }
  // Each of two edges may be off by its own tolerance.
  return free < 2 ? 0 : std::min(2 * tolerance, shortest / 10);
}

bool BrepHost::is_closed() const noexcept {
  for (const int n : state_->uses)
    if (n != 2 && n != 0) return false;  // 0: an edge that no face holds
  return true;
}

std::string BrepHost::failure(int face) const {
  const std::scoped_lock lock(state_->mutex);
  const auto found = state_->failures.find(face);
  return found == state_->failures.end() ? std::string() : found->second;
}

}  // namespace carreau_occ
