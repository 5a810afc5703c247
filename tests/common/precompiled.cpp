// SPDX-License-Identifier: BSD-3-Clause
// Empty: its precompiled headers serve all test programs.
