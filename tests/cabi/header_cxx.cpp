// SPDX-License-Identifier: BSD-3-Clause
// carreau.h is C++ too, from C++11 on.
#include "carreau.h"

carreau_status carreau_h_in_cxx11() { return CARREAU_OK; }
