# Included by the project when mutants.py configures it: a mutant compiles its own unit again, not all of its room's.
cmake_language(DEFER CALL set_target_properties mortise PROPERTIES UNITY_BUILD OFF)
