// Exceptions of the library as those of Python.

#include "bindings.hpp"

#include <arcslip/ensemble/ensemble.hpp>
#include <arcslip/optimize/nlopt/minimize.hpp>
#include <arcslip/scene/scene.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <exception>

namespace nb = nanobind;

namespace arcslip::python {
namespace {

/// Sets an exception of the module arcslip.errors.
template <class... Arguments>
void raise(const char* type, const Arguments&... arguments) {
  const nb::object made = nb::module_::import_("arcslip.errors").attr(type)(arguments...);
  PyErr_SetObject(made.type().ptr(), made.ptr());
}

void translate(const std::exception_ptr& thrown, void* /*payload*/) {
  try {
    std::rethrow_exception(thrown);
  } catch (const scene::SceneError& error) {
    nb::list faults;
    for (const scene::Fault& fault : error.faults())
      faults.append(nb::make_tuple(fault.pointer, fault.message));
    raise("SceneError", faults);
  } catch (const scene::ParameterError& error) {
    raise("ParameterError", error.what());
  } catch (const scene::FileError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  } catch (const ensemble::UnknownQuantity& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  } catch (const ensemble::OtherEnsemble& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  } catch (const ensemble::FileFault& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  } catch (const optimize::OptionsError& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  }
}

}  // namespace

void bind_errors(nb::module_& /*core*/) {
  nb::register_exception_translator(translate);
}

}  // namespace arcslip::python
