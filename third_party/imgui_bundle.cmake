# Sets imgui_bundle_SOURCE_DIR to the unpacked PyPI source package imgui_bundle_version, downloading
# it if needed. pip verifies imgui_bundle_sha256; the archive is kept in the cache of the user so
# that other clones need no network.
if(DEFINED ENV{XDG_CACHE_HOME})
  set(cache_root "$ENV{XDG_CACHE_HOME}")
else()
  set(cache_root "$ENV{HOME}/.cache")
endif()
set(LIGHTBENCH_DOWNLOADS "${cache_root}/lightbench" CACHE PATH "Where downloaded sources are kept")
set(bundle_archive "${LIGHTBENCH_DOWNLOADS}/imgui_bundle-${imgui_bundle_version}.tar.gz")
set(imgui_bundle_SOURCE_DIR "${CMAKE_CURRENT_BINARY_DIR}/imgui_bundle-${imgui_bundle_version}")
set(bundle_stamp "${imgui_bundle_SOURCE_DIR}/${imgui_bundle_sha256}")

if(NOT EXISTS "${bundle_stamp}")
  set(actual "")
  if(EXISTS "${bundle_archive}")
    file(SHA256 "${bundle_archive}" actual)
  endif()
  if(NOT actual STREQUAL imgui_bundle_sha256)
    message(STATUS "Downloading imgui-bundle ${imgui_bundle_version} (54 MB) to ${LIGHTBENCH_DOWNLOADS}")
    set(work "${CMAKE_CURRENT_BINARY_DIR}/download")
    file(REMOVE_RECURSE "${work}")
    file(WRITE "${work}/requirements.txt"
      "imgui-bundle==${imgui_bundle_version} --hash=sha256:${imgui_bundle_sha256}\n")
    # `pip download` asks the package's build backend for metadata, and the real backend would be
    # installed from the network and take a minute. We want the archive alone, so the backend that
    # pip finds is this one, which answers at once.
    file(WRITE "${work}/backend/scikit_build_core/__init__.py" "")
    file(WRITE "${work}/backend/scikit_build_core/build.py" [[
import pathlib


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    name = "imgui_bundle-1.93.0.dist-info"
    info = pathlib.Path(metadata_directory, name)
    info.mkdir()
    info.joinpath("METADATA").write_text(
        "Metadata-Version: 2.1\nName: imgui-bundle\nVersion: 1.93.0\n")
    return name
]])
    find_program(LIGHTBENCH_PYTHON python3 HINTS /usr/bin NO_DEFAULT_PATH REQUIRED)
    execute_process(
      COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${work}/backend" PIP_ROOT_USER_ACTION=ignore
        "${LIGHTBENCH_PYTHON}" -m pip download --quiet --disable-pip-version-check --no-cache-dir
        --no-deps --no-binary imgui-bundle --no-build-isolation --require-hashes
        -r requirements.txt --dest "${work}"
      WORKING_DIRECTORY "${work}" RESULT_VARIABLE failed)
    if(failed)
      message(FATAL_ERROR "pip could not download imgui-bundle ${imgui_bundle_version} from PyPI (see "
        "above). It needs python3-pip and a network, or the archive at ${bundle_archive}.")
    endif()
    file(MAKE_DIRECTORY "${LIGHTBENCH_DOWNLOADS}")
    file(RENAME "${work}/imgui_bundle-${imgui_bundle_version}.tar.gz" "${bundle_archive}.part")
    file(RENAME "${bundle_archive}.part" "${bundle_archive}")
    file(REMOVE_RECURSE "${work}")
  endif()
  set(top "imgui_bundle-${imgui_bundle_version}/external")
  file(ARCHIVE_EXTRACT INPUT "${bundle_archive}" DESTINATION "${CMAKE_CURRENT_BINARY_DIR}"
    PATTERNS
      "${top}/imgui/imgui/*" "${top}/implot/implot/*" "${top}/ImGuizmo/ImGuizmo/*"
      "${top}/imgui_test_engine/imgui_test_engine/imgui_test_engine/*"
      "${top}/hello_imgui/hello_imgui/src/hello_imgui/icons_font_awesome_6.h"
      "${top}/hello_imgui/hello_imgui/hello_imgui_assets/fonts/Font_Awesome_6_Free-Solid-900.otf")
  file(TOUCH "${bundle_stamp}")
endif()
