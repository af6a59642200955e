//! Named choices of a simulation, and the macro that declares a choice. Each enum owns its names.

use std::fmt;

/// Error: no choice has this name.
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

/// Declares an enum with one name for each variant. Serde, `Display` and `FromStr` use these names. The enum has a default if a
/// plan may leave out its key.
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
                /// Choice if the plan gives none.
                pub const DEFAULT: Self = Self::$default;
            )?
            /// All choices, in the order of declaration.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];
            /// Names of all choices, in the same order.
            pub const NAMES: &'static [&'static str] = &[$($name),+];

            /// Name in plans, on the command line and in results.
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
