// Nothing: the headers that are precompiled for it are those of all test programs.
