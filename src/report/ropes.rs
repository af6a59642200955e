//! The rope catalogue as text.
