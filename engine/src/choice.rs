//! The named choices of a simulation, and how a choice is declared: each enum owns its names.

use std::fmt;

/// A name that none of the choices has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName {
    /// The name as written.
    pub name: String,
    /// The names that exist.
    pub known: &'static [&'static str],
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "'{}' is none of {}", self.name, self.known.join(", "))
    }
}

impl std::error::Error for UnknownName {}

/// Declares an enum whose variants have one name each; serde, `Display` and `FromStr` use these names. An enum has a default
/// where its key may be left out of a plan.
#[macro_export]
macro_rules! choice {
    (
        $(#[$about:meta])*
        $choice:ident $(, default $default:ident)? { $( $(#[$about_variant:meta])* $variant:ident = $name:literal, )+ }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
        pub enum $choice {
            $( $(#[$about_variant])* #[serde(rename = $name)] $variant, )+
        }

        impl $choice {
            $(
                /// The choice where a plan says nothing.
                pub const DEFAULT: Self = Self::$default;
            )?
            /// Every choice, in the order of declaration.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];
            /// Names of all choices, in the same order.
            pub const NAMES: &'static [&'static str] = &[$($name),+];

            /// The name in plans, on the command line and in results.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),+ }
            }
        }

        impl std::fmt::Display for $choice {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        impl std::str::FromStr for $choice {
            type Err = $crate::choice::UnknownName;

            fn from_str(name: &str) -> Result<Self, $crate::choice::UnknownName> {
                let found = Self::ALL.iter().copied().find(|choice| choice.name() == name);
                found.ok_or_else(|| $crate::choice::UnknownName { name: name.to_owned(), known: Self::NAMES })
            }
        }
    };
}

choice! {
    /// Time integration method.
    Method, default Verlet {
        /// Explicit; contact in closed form.
        Verlet = "verlet",
        /// Implicit; the method of the source paper.
        Newmark = "newmark",
    }
}
