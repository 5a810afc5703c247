// SPDX-License-Identifier: BSD-3-Clause
// Healing with known curves on planes and without copies of shapes gives the shapes of OpenCASCADE: random solids and
// broken ones, compared bit by bit.
#include <gtest/gtest.h>
#include <known_curves.h>
#include <quick_healing.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BinTools.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <random>
#include <sstream>

namespace {

/// Random numbers that are the same with every library.
class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  std::size_t below(std::size_t count) { return engine_() % count; }
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967295.0);
  }

 private:
  std::mt19937 engine_;
};

/// A box, perhaps with an edge that is rounded.
TopoDS_Shape box(const gp_Ax2& axes, Dice& dice) {
  const TopoDS_Shape sharp =
      BRepPrimAPI_MakeBox(axes, dice.between(0.5, 3), dice.between(0.5, 3), dice.between(0.5, 3)).Shape();
  if (dice.below(3) > 0) return sharp;
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(sharp, TopAbs_EDGE, edges);
  BRepFilletAPI_MakeFillet fillet(sharp);
  fillet.Add(dice.between(0.05, 0.4), TopoDS::Edge(edges(1 + static_cast<int>(dice.below(12)))));
  return fillet.Shape();
}

TopoDS_Shape primitive(Dice& dice) {
  const auto length = [&] { return dice.between(0.5, 3); };
  const gp_Ax2 axes(gp_Pnt(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)),
                    dice.below(2) == 0 ? gp::DZ() : gp_Dir(dice.between(-1, 1), dice.between(-1, 1), 1));
  switch (dice.below(6)) {
    case 0:
      return BRepPrimAPI_MakeCylinder(axes, length(), length()).Shape();
    case 1:
      return BRepPrimAPI_MakeCone(axes, length(), 0.4, length()).Shape();
    case 2:
      return BRepPrimAPI_MakeSphere(axes, length()).Shape();
    case 3:
      return BRepPrimAPI_MakeTorus(axes, 1 + length(), 0.4).Shape();
    default:
      return box(axes, dice);
  }
}

TopoDS_Shape solid(Dice& dice) {
  TopoDS_Shape shape = primitive(dice);
  for (std::size_t more = dice.below(4); more > 0; --more) {
    const TopoDS_Shape other = primitive(dice);
    shape = dice.below(2) == 0 ? BRepAlgoAPI_Fuse(shape, other).Shape() : BRepAlgoAPI_Cut(shape, other).Shape();
  }
  return shape;
}

/// Damages entities of a STEP file.
class Breaker {
 public:
  Breaker(std::string& text, Dice& dice) : text_(text), dice_(dice) {}

  void damage() {
    constexpr double shifts[] = {1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1};
    const double shift = shifts[dice_.below(9)] * (dice_.below(2) == 0 ? 1 : -1);
    switch (dice_.below(10)) {
      case 0:
      case 1:
      case 2:
        return shift_number("CARTESIAN_POINT(", shift);
      case 3:
        return shift_number("DIRECTION(", shift);
      case 4:
        return shift_number("CIRCLE(", shift);
      case 5:
        return flip("ORIENTED_EDGE(");
      case 6:
        return flip(dice_.below(2) == 0 ? "EDGE_CURVE(" : "ADVANCED_FACE(");
      case 7:
        return flip(dice_.below(2) == 0 ? "FACE_BOUND(" : "FACE_OUTER_BOUND(");
      case 8:
        return shift_number("UNCERTAINTY_MEASURE_WITH_UNIT(", std::abs(shift));
      default:
        return change_list("EDGE_LOOP(");
    }
  }

 private:
  /// The begin and the end of the parameters of a random entity of a type. False: no such entity.
  bool choose(const std::string& type, std::size_t& first, std::size_t& last) {
    std::vector<std::size_t> places;
    for (std::size_t at = text_.find("= " + type); at != std::string::npos; at = text_.find("= " + type, at + 1))
      places.push_back(at + 2 + type.size());
    for (std::size_t at = text_.find("=" + type); at != std::string::npos; at = text_.find("=" + type, at + 1))
      places.push_back(at + 1 + type.size());
    if (places.empty()) return false;
    first = places[dice_.below(places.size())];
    last = text_.find(';', first);
    return last != std::string::npos;
  }

  void shift_number(const std::string& type, double shift) {
    std::size_t first = 0, last = 0;
    if (!choose(type, first, last)) return;
    std::vector<std::size_t> numbers;
    for (std::size_t i = first; i < last; ++i)
      if ((std::isdigit(text_[i]) || text_[i] == '-') && (text_[i - 1] == '(' || text_[i - 1] == ','))
        numbers.push_back(i);
    if (numbers.empty()) return;
    const std::size_t at = numbers[dice_.below(numbers.size())];
    const std::size_t size = text_.find_first_of(",)", at) - at;
    std::ostringstream value;
    value << std::setprecision(17) << std::scientific << std::uppercase << std::stod(text_.substr(at, size)) + shift;
    text_.replace(at, size, value.str());
  }

  void flip(const std::string& type) {
    std::size_t first = 0, last = 0;
    if (!choose(type, first, last)) return;
    const std::size_t at = text_.find_last_of("TF", last);
    if (at > first && text_[at - 1] == '.') text_[at] = text_[at] == 'T' ? 'F' : 'T';
  }

  /// One entry is left out, written twice, or comes last.
  void change_list(const std::string& type) {
    std::size_t first = 0, last = 0;
    if (!choose(type, first, last)) return;
    const std::size_t from = text_.find('(', first) + 1, to = text_.find(')', from);
    std::vector<std::string> entries(1);
    for (const char c : text_.substr(from, to - from))
      if (c == ',')
        entries.emplace_back();
      else
        entries.back() += c;
    const std::size_t i = dice_.below(entries.size());
    const std::string entry = entries[i];
    const std::size_t how = entries.size() > 1 ? dice_.below(3) : 0;
    if (how > 0) entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(i));
    if (how < 2) entries.push_back(entry);
    std::string list;
    for (const std::string& each : entries) list += (list.empty() ? "" : ",") + each;
    text_.replace(from, to - from, list);
  }

  std::string& text_;
  Dice& dice_;
};

class KnownCurves : public testing::Test {
 protected:
  KnownCurves() : file_(std::filesystem::temp_directory_path() / name()) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~KnownCurves() override { std::filesystem::remove(file_); }

  [[nodiscard]] std::string text_of(const TopoDS_Shape& shape, bool with_curves) const {
    STEPControl_Writer writer;
    Interface_Static::SetIVal("write.surfacecurve.mode", with_curves ? 1 : 0);
    writer.Transfer(shape, STEPControl_AsIs);
    writer.Write(file_.c_str());
    std::ostringstream text;
    text << std::ifstream(file_, std::ios::binary).rdbuf();
    return text.str();
  }
  void write(const std::string& text) const {
    std::ofstream stream(file_, std::ios::binary | std::ios::trunc);
    stream << text;
  }

  /// All of a shape as it is read and healed: curves, tolerances, flags, places.
  [[nodiscard]] std::string healed() const {
    STEPControl_Reader reader;
    std::ostringstream out;
    if (reader.ReadFile(file_.c_str()) != IFSelect_RetDone) return "unread";
    reader.TransferRoots();
    for (int i = 1; i <= reader.NbShapes(); ++i) BinTools::Write(reader.Shape(i), out);
    return out.str();
  }
  [[nodiscard]] std::string healed_quickly() const {
    const carreau_occ::KnownCurves known;
    const carreau_occ::QuickHealing quick;
    return healed();
  }

 private:
  static std::string name() {
    return std::string("carreau_known_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".step";
  }
  std::filesystem::path file_;
};

TEST_F(KnownCurves, SolidsAreHealedTheSame) {
  int whole = 0;  // others are cut away
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Dice dice(seed);
    write(text_of(solid(dice), dice.below(2) == 0));
    const std::string plain = healed();
    whole += plain.size() > 500 ? 1 : 0;
    EXPECT_TRUE(plain == healed_quickly()) << "solid " << seed;
  }
  EXPECT_GT(whole, 8);
}

TEST_F(KnownCurves, BrokenSolidsAreHealedTheSame) {
  int changed = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    Dice dice(1000 + seed);
    const std::string sound = text_of(solid(dice), dice.below(2) == 0);
    std::string text = sound;
    for (std::size_t damages = 1 + dice.below(4); damages > 0; --damages) Breaker(text, dice).damage();
    write(sound);
    const std::string before = healed();
    write(text);
    const std::string plain = healed();
    changed += before != plain ? 1 : 0;
    EXPECT_TRUE(plain == healed_quickly()) << "solid " << seed;
  }
  EXPECT_GT(changed, 15);
}

}  // namespace
