// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/host/shared_host.h"

#include <dlfcn.h>

#include "files/mesh_file.h"
#include "inputs/host/host_faults.h"

namespace command {

namespace {

template <typename Routine>
void find(void* library, const std::string& name, Routine& routine) {
  for (const std::string& symbol : {name, "__cad_m_MOD_" + name, "cad_m_mp_" + name + "_", name + "_"})
    if (void* address = dlsym(library, symbol.c_str())) {
      routine = reinterpret_cast<Routine>(address);  // POSIX: a function's address fits
      return;
    }
}

}  // namespace

SharedHost::SharedHost(const std::string& path) {
  // A name without a slash would be looked for in the folders of the system.
  const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* why = dlerror();
    throw Failure("The shared library '" + path + "' cannot be loaded: " + (why != nullptr ? why : "no reason given"));
  }
  carreau_cad_m& r = routines_;
  r.struct_size = sizeof r;
  find(library, "cad_init", r.cad_init);
  find(library, "surf0", r.surf0);
  find(library, "surf1", r.surf1);
  find(library, "surf2", r.surf2);
  find(library, "curv_int", r.curv_int);
  find(library, "curv0", r.curv0);
  find(library, "curv1", r.curv1);
  find(library, "curv2", r.curv2);
  find(library, "cad_hphys", r.cad_hphys);
  find(library, "cad_hphyc", r.cad_hphyc);
  find(library, "cad_hphyp", r.cad_hphyp);
  find(library, "cad_rads", r.cad_rads);
  find(library, "cad_radc", r.cad_radc);
  std::string missing;
  for (const auto& [name, found] :
       {std::pair{"surf0", r.surf0 != nullptr}, std::pair{"curv_int", r.curv_int != nullptr},
        std::pair{"curv0", r.curv0 != nullptr}})
    if (!found) missing += (missing.empty() ? "" : ", ") + std::string(name);
  if (!missing.empty())
    throw Failure("The shared library '" + path + "' lacks " + missing +
                  ", alone or in a Fortran module cad_m: these are needed.");
  watch_host(path, reinterpret_cast<const void*>(r.surf0));
}

}  // namespace command
