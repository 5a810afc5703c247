// SPDX-License-Identifier: BSD-3-Clause
// The scanner of plain STEP files against OpenCASCADE's: whatever it accepts, the models are the same.
#include <gtest/gtest.h>
#include <plain_step.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <Interface_Check.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepData_WriterLib.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <filesystem>
#include <fstream>
#include <random>
#include <regex>
#include <sstream>

namespace {

using carreau_occ::PlainStepLibrary;
using Model = Handle(Interface_InterfaceModel);

class PlainStep : public testing::Test {
 protected:
  PlainStep() : file_(std::filesystem::temp_directory_path() / name()) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
    protocol_ = reader_.WS()->Protocol();
  }
  ~PlainStep() override { std::filesystem::remove(file_); }

  void write(const std::string& text) const {
    std::ofstream stream(file_, std::ios::binary | std::ios::trunc);
    stream << text;
  }

  /// The content of a model: entities with their numbers, types and values, as OpenCASCADE writes them, and its complaints.
  /// It cannot write entities that it complained of.
  [[nodiscard]] std::string dump(const Model& model) const {
    std::ostringstream out;
    const Handle(StepData_Protocol) step = Handle(StepData_Protocol)::DownCast(protocol_);
    StepData_StepWriter writer(Handle(StepData_StepModel)::DownCast(model));
    writer.SendModel(step, Standard_True);
    writer.SendData();
    const StepData_WriterLib library(step);
    for (int i = 1; i <= model->NbEntities(); ++i) {
      out << model->StringLabel(model->Value(i))->String() << ' ' << model->TypeName(model->Value(i));
      const Handle(Interface_Check) check = model->Check(i, Standard_True);
      for (int k = 1; k <= check->NbFails(); ++k) out << "\n  " << check->CFail(k);
      for (int k = 1; k <= check->NbWarnings(); ++k) out << "\n  " << check->CWarning(k);
      out << '\n';
      if (check->NbFails() == 0) writer.SendEntity(i, library);
    }
    out << model->GlobalCheck()->NbFails() << ' ' << model->GlobalCheck()->NbWarnings() << '\n';
    writer.EndSec();
    writer.EndFile();
    writer.Print(out);
    return out.str();
  }

  /// Returns true if a file is plain; both readers must then agree.
  bool compare(const std::string& text) {
    write(text);
    Model plain, whole;
    if (!PlainStepLibrary::read_plain(file_.c_str(), plain, protocol_)) return false;
    EXPECT_EQ(StepSelect_WorkLibrary(Standard_False).ReadFile(file_.c_str(), whole, protocol_), 0) << text;
    if (whole.IsNull()) return true;
    const std::string a = dump(plain), b = dump(whole);
    EXPECT_EQ(a, b) << text;
    return true;
  }

  [[nodiscard]] std::string text_of(const TopoDS_Shape& shape) const {
    STEPControl_Writer writer;
    writer.Transfer(shape, STEPControl_AsIs);
    writer.Write(file_.c_str());
    std::ostringstream text;
    text << std::ifstream(file_, std::ios::binary).rdbuf();
    return std::regex_replace(text.str(), std::regex("'20[0-9T:-]*'"), "'2000-01-01T00:00:00'");  // the same damages every day
  }

 private:
  static std::string name() {
    return std::string("carreau_plain_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".step";
  }
  std::filesystem::path file_;
  STEPControl_Reader reader_;
  Handle(Interface_Protocol) protocol_;
};

std::string with_entities(const std::string& entities) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('a','b'),'2;1');\nFILE_NAME('n','t',(''),(''),'','','');\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n" +
         entities + "\nENDSEC;\nEND-ISO-10303-21;\n";
}

TEST_F(PlainStep, IsReadAsByOpenCascade) {
  for (const char* const entities :
       {"#1=CARTESIAN_POINT('',(0.,-1.5,2.5E-3));", "#1 \t= CARTESIAN_POINT ( 'p' , ( +0. , 1.E5 , 12.25E+10 ) ) ;",
        "#1=CARTESIAN_POINT('it''s, odd',(0.,1.,2.));", "#1=CARTESIAN_POINT('two\n  lines\r\n',(0.,1.,2.));",
        "#1=CARTESIAN_POINT('''',(0.,1.,2.));#2=CARTESIAN_POINT('a'' ,(0.,1.,2.));",
        "/* one * / **/#1=/*'*/CARTESIAN_POINT('/* none */',/* two */(0.,1./**/,2.));", "#1=NO_SUCH_THING('',());",
        "#1=DIRECTION('x',(1,0,-1));", "#1=VERTEX_POINT('',#3);#3=CARTESIAN_POINT('',(0.,1.,2.));",
        "#1=ORIENTED_EDGE('',*,*,#2,.T.);#2=EDGE_CURVE('',$,$,$,.F.);", "#1=NO_SUCH_THING(1,(2,(3,('x',.U.)),$),*);",
        "#7=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));",
        "#7=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#8,'d','a');#8=(NAMED_UNIT(*)LENGTH_UNIT());",
        "#1=NESTED(((1),(2)),((3),(4)),((5),(6)),((7),(8)),((9),(10)),LENGTH_MEASURE((11.)));",
        "#1=CARTESIAN_POINT('\\X2\\00E9\\X0\\',(0.,1.,2.));", "#1=CARTESIAN_POINT('',(0.,1.,2.,3.,4.));"})
    EXPECT_TRUE(compare(with_entities(entities))) << entities;
}

TEST_F(PlainStep, LeavesTheRestToOpenCascade) {
  for (const char* const entities : {"#1=CARTESIAN_POINT('',(0.,1.,.5));",
                                     "#1=CARTESIAN_POINT('',(0.,1.,1E5));",
                                     "#1=Cartesian_Point('',());",
                                     "#1=CARTESIAN_POINT('',(0.,1.,1.e5));",
                                     "#1\n=CARTESIAN_POINT('',());",
                                     "#1=CARTESIAN_POINT('',(0.,,1.));",
                                     "#1=CARTESIAN_POINT('',(0.,1.,2.);",
                                     "#1=CARTESIAN_POINT('',(0.,1.,2.)))",
                                     "#1=&SCOPE #2=A();ENDSCOPE B();",
                                     "#1=!USERS('',(0.,1.,2.));",
                                     "#1=A(\"0F\");",
                                     "#1=A('b' /* c */);)",
                                     "#1=A('b'\t);",
                                     "#12345678901=A();",
                                     "#1=A(1.5.);",
                                     "#1=A(#);",
                                     "#1=A(..);",
                                     "#1=A(/* );",
                                     "=A();",
                                     "#1=A;",
                                     "#1=A()",
                                     "#1=ENDSCOPE();",
                                     "#1=CARTESIAN_POINT('',(0.,1.,2.));#1=CARTESIAN_POINT('',(0.,1.,2.));",
                                     "#1=VERTEX_POINT('',#99);",
                                     "",
                                     "x"})
    EXPECT_FALSE(compare(with_entities(entities))) << entities;
  const std::string whole = with_entities("#1=A();");
  EXPECT_TRUE(compare(whole));
  EXPECT_FALSE(compare(whole.substr(1)));
  EXPECT_FALSE(compare(whole.substr(0, whole.size() - 10)));
  EXPECT_FALSE(compare(whole.substr(0, 30) + '\0' + whole.substr(30)));
  EXPECT_FALSE(compare(""));
}

TEST_F(PlainStep, DamagedFilesAreReadAsByOpenCascade) {
  const std::string sound =
      text_of(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(2, 3, 4).Shape(), BRepPrimAPI_MakeCylinder(0.5, 9).Shape()).Shape());
  ASSERT_TRUE(compare(sound));
  constexpr std::string_view characters = "',()#*$.;=/\"&!AEZ_az019+- \n\t\r\\@";
  std::mt19937 random(7);
  const auto below = [&](std::size_t count) { return random() % count; };
  int plain = 0, others = 0;
  for (int i = 0; i < 300; ++i) {
    std::string text = sound;
    for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
      const std::size_t place = below(text.size());
      const std::size_t size = below(4);
      text.replace(place, size, std::string(below(3), characters[below(characters.size())]));
    }
    ++(compare(text) ? plain : others);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(plain, 50);
  EXPECT_GT(others, 50);
}

}  // namespace
