# SPDX-License-Identifier: BSD-3-Clause
class Carreau < Formula
  desc "Conforming meshes of surfaces made of parametric patches"
  homepage "https://example.org/carreau"
  url "https://example.org/carreau-0.1.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license "BSD-3-Clause"

  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "eigen" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkgconf" => :build
  depends_on "libpng"
  depends_on "muparser"
  depends_on "opencascade"
  depends_on "openexr"
  depends_on "tbb"
  uses_from_macos "zlib"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DCARREAU_WERROR=OFF", "-DCARREAU_TESTS=OFF",
           "-DCARREAU_FORTRAN=OFF", "-DCARREAU_MED=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    system bin/"carreau", "mesh", "z = x * y", "-o", "saddle.vtu", "--size", "5%"
    system bin/"carreau", "check", "saddle.vtu"
  end
end
