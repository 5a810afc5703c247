// SPDX-License-Identifier: BSD-3-Clause
#include "io/molecule/molecule_files.h"

#include <gtest/gtest.h>

#include <sstream>
#include <type_traits>

#include "io/molecule/elements.h"
#include "support/error.h"

namespace carreau {
namespace {

std::string data(const std::string& name) { return std::string(CARREAU_SOURCE_DIR) + "/tests/data/molecule/" + name; }

template <typename Read>
std::string refusal(Read&& read, const std::string& text) {
  try {
    if constexpr (std::is_invocable_v<Read, const std::string&, const char*>)
      read(text, "m");
    else
      read(text, "m", Radii{});
  } catch (const FileError& error) {
    EXPECT_GT(error.where().line, 0);
    return error.what();
  }
  return "";
}

const std::string residue = "ATOM      7  CA  ALA B  12      18.935  34.195  25.617  1.00 64.35           C  \n";

TEST(MoleculeFiles, TheSameMoleculeComesFromTwoFormats) {
  const MoleculeFile bank = read_molecule(data("1bna.pdb")), balls = read_molecule(data("1bna.xyzr"));
  ASSERT_EQ(bank.molecule.balls.size(), 486U);
  ASSERT_EQ(balls.molecule.balls.size(), 486U);
  for (std::size_t i = 0; i < 486; ++i) {
    EXPECT_EQ(bank.molecule.balls[i].centre, balls.molecule.balls[i].centre);
    EXPECT_EQ(bank.molecule.balls[i].radius, balls.molecule.balls[i].radius);
  }
  EXPECT_EQ(bank.molecule.numbers[0], 1);
  EXPECT_EQ(bank.molecule.names[0], "DC A 1");
  EXPECT_EQ(bank.remarks, (std::vector<std::string>{"80 atoms of waters are left out"}));
}

TEST(MoleculeFiles, PdbHasElementsAndAlternateLocations) {
  const std::string text = residue +
                           "ATOM      8  CB AALA B  12       1.0     2.0     3.0    1.00 64.35           C  \n"
                           "ATOM      9  CB BALA B  12       1.1     2.0     3.0    1.00 64.35           C  \n"
                           "HETATM   10 ZN    ZN B  13       4.0     2.0     3.0    1.00 64.35\n"
                           "ATOM     11 HG11 VAL B  14       9.0     2.0     3.0\n";
  const MoleculeFile file = read_pdb(text, "m");
  EXPECT_EQ(file.molecule.elements, (std::vector<std::string>{"C", "C", "Zn", "H"}));
  EXPECT_EQ(file.molecule.numbers, (std::vector<int>{7, 8, 10, 11}));
  EXPECT_EQ(file.molecule.balls[2].radius, 1.39);
  EXPECT_EQ(file.remarks, (std::vector<std::string>{"1 atoms at alternate locations are left out"}));
}

TEST(MoleculeFiles, OnlyTheFirstModelOfAPdbIsRead) {
  const MoleculeFile file = read_pdb("MODEL        1\n" + residue + "ENDMDL\nMODEL        2\n" + residue, "m");
  EXPECT_EQ(file.molecule.balls.size(), 1U);
  EXPECT_EQ(file.remarks, (std::vector<std::string>{"models after the first one are not read"}));
}

TEST(MoleculeFiles, SerialNumbersThatRepeatAreNotUsed) {
  const MoleculeFile file = read_pdb(residue + residue, "m");
  EXPECT_TRUE(file.molecule.numbers.empty());
  EXPECT_EQ(file.remarks.size(), 1U);
}

const std::string cif_names =
    "data_X\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_comp_id\n_atom_site.Cartn_x\n"
    "_atom_site.Cartn_y\n_atom_site.Cartn_z\n";

TEST(MoleculeFiles, MmcifHasQuotesTextsAndOtherLoops) {
  const MoleculeFile file = read_mmcif("data_X\nloop_\n_a.b\n_a.c\n'x y' \"don't\"\n;loop_\n_atom_site.id\n;\n1\n" +
                                           cif_names + "5 C 'A' 1.0 2 3 # end\n6 Cl B -1 .5 1e1\n_c.d 7\n",
                                       "m");
  ASSERT_EQ(file.molecule.balls.size(), 2U);
  EXPECT_EQ(file.molecule.balls[1].centre, (Vec3{-1, 0.5, 10}));
  EXPECT_EQ(file.molecule.balls[1].radius, 1.75);
  EXPECT_EQ(file.molecule.numbers, (std::vector<int>{5, 6}));
  EXPECT_EQ(file.molecule.names[0], "A");
}

TEST(MoleculeFiles, XyzHasItsFirstFrame) {
  const MoleculeFile file = read_xyz("2\ntitle\nC 0 0 0\nh 1 0 0 0.3\n2\nnext\n", "m");
  EXPECT_EQ(file.molecule.elements, (std::vector<std::string>{"C", "H"}));
  EXPECT_EQ(file.remarks.size(), 1U);
}

TEST(MoleculeFiles, EachMistakeHasASentenceWithItsLine) {
  EXPECT_EQ(refusal(read_xyzr, ""), "m, line 1: the file holds no atom");
  EXPECT_EQ(refusal(read_xyzr, "# none\n\n"), "m, line 2: the file holds no atom");
  EXPECT_EQ(refusal(read_xyzr, "0 0 0 1\n0 0 x 1\n"), "m, line 2: z is 'x', which is not a finite number");
  EXPECT_EQ(refusal(read_xyzr, "0 0 0\n"), "m, line 1: the radius is missing");
  EXPECT_EQ(refusal(read_xyzr, "0 0 0 0\n"), "m, line 1: the radius is 0; it must be positive");
  EXPECT_EQ(refusal(read_xyzr, "0 0 nan 1\n"), "m, line 1: z is 'nan', which is not a finite number");
  EXPECT_EQ(refusal(read_xyz, ""), "m, line 1: the file is empty");
  EXPECT_EQ(refusal(read_xyz, "x\n"), "m, line 1: the first line is 'x'; it must be a positive number of atoms");
  EXPECT_EQ(refusal(read_xyz, "2\n\nC 0 0 0\n"), "m, line 3: the file ends after 1 of 2 atoms");
  EXPECT_EQ(refusal(read_xyz, "1\n\nQq 0 0 0\n"),
            "m, line 3: 'Qq' is not an element of the periodic table: it has no van der Waals radius");
  EXPECT_EQ(refusal(read_pdb, "HEADER\nATOM      7  CA  ALA B  12      18.9\n"), "m, line 2: y is missing");
  EXPECT_EQ(refusal(read_pdb, "HETATM    3  O   HOH A   3      19.736  30.706  18.656\n"),
            "m, line 1: the file holds no atom but of waters");
  EXPECT_EQ(refusal(read_mmcif, cif_names + "1 C A 0 0\n"),
            "m, line 10: the last row of _atom_site has 5 values, not 6");
  EXPECT_EQ(refusal(read_mmcif, cif_names + "1 C A 0 ? 0\n"), "m, line 9: Cartn_y is missing");
  EXPECT_EQ(refusal(read_mmcif, "data_X\n;text\n"), "m, line 2: the text that begins here does not end");
  EXPECT_EQ(refusal(read_mmcif, "data_X\n_a.b 'x\n"), "m, line 2: a quote that begins here does not end on its line");
  EXPECT_THROW(read_molecule("m.sdf"), FileError);
}

TEST(MoleculeFiles, ElementsHaveTheRadiiOfBondiElseOfAlvarez) {
  EXPECT_EQ(van_der_waals_radius("C"), 1.70);
  EXPECT_EQ(van_der_waals_radius(element_symbol("ZN")), 1.39);
  EXPECT_EQ(van_der_waals_radius("Ag"), 1.72);
  EXPECT_EQ(van_der_waals_radius("Xe"), 2.16);
  EXPECT_EQ(van_der_waals_radius("Fe"), 2.44);
  EXPECT_EQ(van_der_waals_radius("Ca"), 2.62);
  EXPECT_EQ(van_der_waals_radius("Po"), 1.97);
  EXPECT_FALSE(van_der_waals_radius(""));
  EXPECT_FALSE(van_der_waals_radius("Qq"));
}

TEST(MoleculeFiles, EveryElementHasARadius) {
  std::istringstream symbols(
      "H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se Br Kr Rb Sr Y Zr Nb Mo "
      "Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er Tm Yb Lu Hf Ta W Re Os Ir Pt Au Hg Tl "
      "Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am Cm Bk Cf Es Fm Md No Lr Rf Db Sg Bh Hs Mt Ds Rg Cn Nh Fl Mc Lv Ts Og");
  int count = 0;
  for (std::string symbol; symbols >> symbol; ++count) {
    const auto radius = van_der_waals_radius(symbol);
    ASSERT_TRUE(radius) << symbol;
    EXPECT_TRUE(*radius >= 1.2 && *radius <= 3.5) << symbol;
  }
  EXPECT_EQ(count, 118);
}

TEST(MoleculeFiles, AFileOfRadiiReplacesTheTable) {
  const Radii radii = read_radii("# own\nFE 2.05 # haem\n\nc 1.9\nQq 3\n", "r");
  EXPECT_EQ(radii, (Radii{{"Fe", 2.05}, {"C", 1.9}, {"Qq", 3}}));
  const MoleculeFile file = read_xyz("4\n\nFe 0 0 0\nC 1 0 0\nQq 2 0 0\nN 3 0 0\n", "m", radii);
  EXPECT_EQ(file.molecule.balls[0].radius, 2.05);
  EXPECT_EQ(file.molecule.balls[1].radius, 1.9);
  EXPECT_EQ(file.molecule.balls[2].radius, 3);
  EXPECT_EQ(file.molecule.balls[3].radius, 1.55);
  const auto of = [](const char* text) {
    try {
      read_radii(text, "r");
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(of("Fe\n"), "r, line 1: the radius is missing");
  EXPECT_EQ(of("Fe 1\nC -1\n"), "r, line 2: the radius is -1; it must be positive");
  EXPECT_EQ(of("Fe 1\nFE 1\n"), "r, line 2: the radius of Fe is given twice");
  EXPECT_EQ(of("1.5 Fe\n"), "r, line 1: the symbol of an element was expected, not '1.5'");
}

}  // namespace
}  // namespace carreau
