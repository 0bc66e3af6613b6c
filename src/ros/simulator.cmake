find_path(CLI11_INCLUDE_DIR CLI/CLI.hpp)
if(NOT CLI11_INCLUDE_DIR)
  message(FATAL_ERROR "CLI11 was not found; install libcli11-dev, or put include/CLI of https://github.com/CLIUtils/CLI11 into /usr/local/include")
endif()

# What all simulators have in common.
add_library(${PROJECT_NAME}_simulator STATIC
  simulator_arguments.cpp
  simulator_ros.cpp
)
target_include_directories(${PROJECT_NAME}_simulator SYSTEM PRIVATE ${CLI11_INCLUDE_DIR})
target_include_directories(${PROJECT_NAME}_simulator SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
target_link_libraries(${PROJECT_NAME}_simulator PUBLIC
  ${PROJECT_NAME}_sim
  ${catkin_LIBRARIES}
)

add_executable(nmea_simulator simulator_main.cpp)
target_link_libraries(nmea_simulator PRIVATE ${PROJECT_NAME}_simulator)

add_executable(blueye_simulator blueye_simulator_main.cpp)
target_link_libraries(blueye_simulator PRIVATE
  ${PROJECT_NAME}_sim_blueye
  ${PROJECT_NAME}_simulator
)

install(TARGETS blueye_simulator nmea_simulator RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
