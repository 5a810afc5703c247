// SPDX-License-Identifier: BSD-3-Clause
// Nothing: the headers that are precompiled for it are those of all test programs.
