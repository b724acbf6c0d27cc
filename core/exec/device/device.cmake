# The device for which kernels are compiled beside the host: CUDA's, an emulated one, or none. Sources of a device are
# those of the host, compiled once more for the other side (RIVEN_SIDE in core/exec/config.hpp). Where there is none but
# nvcc is found, a test compiles them for CUDA all the same.
include(CheckCompilerFlag)

set(RIVEN_CUDA "OFF" CACHE STRING
  "The CUDA space: AUTO (where nvcc is found), ON, OFF; EMULATED for tests of it without a GPU")
set_property(CACHE RIVEN_CUDA PROPERTY STRINGS AUTO ON OFF EMULATED)
set(RIVEN_CUDA_CHECK "AUTO" CACHE STRING "Compiling the CUDA space as a test: AUTO (where nvcc is found), ON, OFF")
set_property(CACHE RIVEN_CUDA_CHECK PROPERTY STRINGS AUTO ON OFF)
set(RIVEN_CUDA_ARCHITECTURES "90" CACHE STRING "GPUs that it is compiled for; with code for later ones")

set(RIVEN_DEVICE "${RIVEN_CUDA}")
find_program(RIVEN_NVCC nvcc PATHS /usr/local/cuda/bin)
if(RIVEN_CUDA MATCHES "AUTO|ON")
  if(RIVEN_NVCC)
    set(RIVEN_DEVICE ON)
  elseif(RIVEN_CUDA STREQUAL "ON")
    message(FATAL_ERROR "RIVEN_CUDA=ON, but nvcc was not found")
  else()
    message(STATUS "No nvcc: there will be no CUDA space")
    set(RIVEN_DEVICE OFF)
  endif()
endif()
if(RIVEN_CUDA_CHECK STREQUAL "ON" AND NOT RIVEN_NVCC)
  message(FATAL_ERROR "RIVEN_CUDA_CHECK=ON, but nvcc was not found")
endif()

set(RIVEN_DEVICE_CHECKED OFF)
if(RIVEN_DEVICE STREQUAL "OFF" AND RIVEN_NVCC AND NOT RIVEN_CUDA_CHECK STREQUAL "OFF")
  set(RIVEN_DEVICE_CHECKED ON)
endif()
if(RIVEN_DEVICE STREQUAL "ON" OR RIVEN_DEVICE_CHECKED)
  set(CMAKE_CUDA_COMPILER ${RIVEN_NVCC})
  set(CMAKE_CUDA_HOST_COMPILER ${CMAKE_CXX_COMPILER})
  set(CMAKE_CUDA_ARCHITECTURES ${RIVEN_CUDA_ARCHITECTURES})
  set(CMAKE_CUDA_STANDARD 20)
  enable_language(CUDA)
  set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION -std=c++20)  # which CMake 3.25 does not know of
  # 1675: a pragma that only the CPU compilers know; 836: taken for a dangling reference, where a lambda returns what it
  # holds by reference; 128, 177: not reached, not used, where `if constexpr` leaves the rest out.
  target_compile_options(riven_flags INTERFACE "$<$<COMPILE_LANGUAGE:CUDA>:--extended-lambda;--expt-relaxed-constexpr;\
-diag-suppress=1675,836,128,177;-Xcompiler=-fopenmp,-fno-math-errno;$<$<BOOL:${RIVEN_WERROR}>:-Werror=all-warnings>>")
  check_compiler_flag(CUDA --Ofast-compile=max RIVEN_NVCC_HAS_FAST_COMPILE)  # nvcc of 12.9 and later
endif()
if(RIVEN_DEVICE_CHECKED)  # all that nvcc does itself; what it would hand to the host's compiler stays uncompiled
  string(REPLACE "<CUDA_COMPILE_MODE>" "--cuda" CMAKE_CUDA_COMPILE_OBJECT "${CMAKE_CUDA_COMPILE_OBJECT}")
endif()
if(NOT RIVEN_DEVICE STREQUAL "OFF")
  target_compile_definitions(riven_flags INTERFACE RIVEN_DEVICE)
endif()
if(RIVEN_DEVICE STREQUAL "EMULATED")
  target_compile_definitions(riven_flags INTERFACE RIVEN_DEVICE_EMULATED=1)
endif()

# riven_check_only(OBJECTS): compiled for what the compiler says of it, never run; hence without optimisation, which
# leaves calls in place whose stack ptxas cannot tell, and in double alone, as the host's compiler sees float.
function(riven_check_only objects)
  target_compile_options(${objects} PRIVATE $<$<COMPILE_LANGUAGE:CUDA>:-URIVEN_FLOAT>)
  if(RIVEN_NVCC_HAS_FAST_COMPILE)
    target_compile_options(${objects} PRIVATE
      "$<$<COMPILE_LANGUAGE:CUDA>:--Ofast-compile=max;-Xptxas=--suppress-stack-size-warning>")
  endif()
endfunction()

# riven_on_device(TARGET LAUNCHING|SERIAL SOURCES...): adds sources of this folder, compiled for the device's side: by nvcc
# if they launch kernels, by the compiler of the host if they do not. Where they are but checked, nvcc reads the headers
# once for many of them, dealt out to two compilations.
function(riven_on_device target launches)
  if(RIVEN_DEVICE STREQUAL "OFF" AND NOT RIVEN_DEVICE_CHECKED)
    return()
  endif()
  set(objects ${target}_on_device)
  if(NOT TARGET ${objects})
    add_library(${objects} OBJECT)
    set_target_properties(${objects} PROPERTIES UNITY_BUILD OFF)
    target_link_libraries(${objects} PRIVATE riven_flags)
    target_compile_definitions(${objects} PRIVATE RIVEN_DEVICE RIVEN_ON_DEVICE)
    if(RIVEN_DEVICE_CHECKED)
      set_target_properties(${objects} PROPERTIES EXCLUDE_FROM_ALL ON)
      riven_check_only(${objects})
      set_property(GLOBAL APPEND PROPERTY riven_checked_for_cuda ${objects})
    else()
      target_link_libraries(${target} PUBLIC ${objects} $<TARGET_OBJECTS:${objects}>)
    endif()
  endif()
  set(turn 0)
  foreach(source ${ARGN})
    set(copy ${source})
    if(launches STREQUAL "LAUNCHING" AND RIVEN_DEVICE_CHECKED)
      set(copy checked_${turn}.cu)
      math(EXPR turn "1 - ${turn}")
    elseif(launches STREQUAL "LAUNCHING" AND NOT RIVEN_DEVICE STREQUAL "EMULATED")
      string(REGEX REPLACE "cpp$" "cu" copy ${source})
    endif()
    list(APPEND copies ${copy})
    string(APPEND content_${copy} "#include \"${CMAKE_CURRENT_SOURCE_DIR}/${source}\"\n")
  endforeach()
  list(REMOVE_DUPLICATES copies)
  foreach(copy ${copies})
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/on_device/${copy} CONTENT "${content_${copy}}" @ONLY)
    target_sources(${objects} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/on_device/${copy})
  endforeach()
endfunction()
