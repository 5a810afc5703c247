# SPDX-License-Identifier: BSD-3-Clause
# nix-build packaging/nix
{ pkgs ? import <nixpkgs> { } }:

pkgs.stdenv.mkDerivation {
  pname = "carreau";
  version = "0.1.0";
  src = pkgs.lib.cleanSource ../..;

  nativeBuildInputs = with pkgs; [ cmake ninja pkg-config ];
  buildInputs = with pkgs; [ cli11 eigen libpng muparser nlohmann_json opencascade-occt openexr tbb zlib ];

  cmakeFlags = [
    "-DCARREAU_WERROR=OFF"
    "-DCARREAU_TESTS=OFF"
    "-DCARREAU_FORTRAN=OFF"
    "-DCARREAU_MED=OFF"
    "-DCARREAU_PYTHON=OFF"
  ];

  meta = {
    description = "Conforming meshes of surfaces made of parametric patches";
    license = pkgs.lib.licenses.bsd3;
    platforms = pkgs.lib.platforms.unix;
    mainProgram = "carreau";
  };
}
