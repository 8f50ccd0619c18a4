# The cards in the headers of contact treatments and methods that stand alone as a source file: ${method_cards}.
file(GLOB card_headers CONFIGURE_DEPENDS
  ${CMAKE_CURRENT_LIST_DIR}/contact/*.hpp
  ${CMAKE_CURRENT_LIST_DIR}/engines/*.hpp
  ${CMAKE_CURRENT_LIST_DIR}/timestepping/*.hpp)
list(JOIN card_headers "," card_list)
set(method_cards ${PROJECT_BINARY_DIR}/generated/method_cards.cpp)
add_custom_command(
  OUTPUT ${method_cards}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${method_cards} -DHEADERS=${card_list}
          -P ${PROJECT_SOURCE_DIR}/tools/embed_cards.cmake
  DEPENDS ${card_headers} ${PROJECT_SOURCE_DIR}/tools/embed_cards.cmake
  COMMENT "Taking the cards out of the methods' headers"
  VERBATIM)
